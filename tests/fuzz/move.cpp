// Every body that is read moves: it ends well, with numbers, or with a status.

#include "evolve/files/body_file.h"
#include "evolve/run/table_digest.h"
#include "tests/fuzz/moving.h"

using namespace metamorph;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::text_of(data, size);
  core::Body body;
  if (fuzz::is_taken("body", [&] { body = evolve::parse_body(text, "body"); })) {
    fuzz::move(body, evolve::hash_of(text));
  }
  return 0;
}
