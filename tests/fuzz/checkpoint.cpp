// Checkpoints: the bytes as they are, and as fields under a mark and a checksum that are right.

#include "evolve/run/checkpoint.h"

#include <vector>

#include "evolve/run/table_digest.h"
#include "tests/fuzz/contract.h"

using namespace metamorph;

namespace {

/// What stands before the fields is as long as the mark and a checksum.
std::vector<std::uint8_t> with_checksum(std::span<const std::uint8_t> fields) {
  static const std::vector<std::uint8_t> empty = evolve::encode({});
  constexpr std::ptrdiff_t mark_size = 8;
  std::vector<std::uint8_t> bytes(empty.begin(), empty.begin() + mark_size);
  const std::uint64_t sum = evolve::hash_of(fuzz::text_of(fields.data(), fields.size()));
  for (int shift = 56; shift >= 0; shift -= 8) {
    bytes.push_back(static_cast<std::uint8_t>(sum >> shift));
  }
  bytes.insert(bytes.end(), fields.begin(), fields.end());
  return bytes;
}

bool decodes(std::span<const std::uint8_t> bytes) {
  evolve::Checkpoint checkpoint;
  if (!fuzz::is_taken("run", [&] { checkpoint = evolve::decode(bytes, "run"); })) return false;
  // Bytes are compared, for a score may be NaN.
  const std::vector<std::uint8_t> written = evolve::encode(checkpoint);
  fuzz::require(evolve::encode(evolve::decode(written, "written")) == written,
                "a checkpoint comes back");
  return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const bool checksum_is_right = [] {
    const std::vector<std::uint8_t> empty = evolve::encode({});
    return with_checksum(std::span(empty).subspan(16)) == empty;
  }();
  fuzz::require(checksum_is_right, "this file knows how a checkpoint begins");
  const std::span bytes(data, size);
  decodes(bytes);
  decodes(with_checksum(bytes));
  return 0;
}
