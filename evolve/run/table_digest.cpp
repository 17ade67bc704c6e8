#include "evolve/run/table_digest.h"

#include <bit>
#include <cmath>

#include <xxhash.h>

namespace metamorph::evolve {

TableDigest& TableDigest::operator+=(const TableDigest& other) {
  rows += other.rows;
  sum += other.sum;
  return *this;
}

std::uint64_t hash_of(std::string_view bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

void append_bytes(std::string& bytes, std::uint64_t value) {
  for (int shift = 0; shift < 64; shift += 8) {
    bytes += static_cast<char>(static_cast<unsigned char>(value >> shift));
  }
}

void RowHash::add(std::int64_t value) {
  bytes_ += 'i';
  append_bytes(bytes_, static_cast<std::uint64_t>(value));
}

void RowHash::add(double value) {
  constexpr double two_to_63 = 9223372036854775808.0;
  if (std::isnan(value)) {
    add_null();
  } else if (value == std::trunc(value) && value >= -two_to_63 && value < two_to_63) {
    add(static_cast<std::int64_t>(value));
  } else {
    bytes_ += 'r';
    append_bytes(bytes_, std::bit_cast<std::uint64_t>(value));
  }
}

void RowHash::add(std::string_view value) {
  bytes_ += 't';
  append_bytes(bytes_, value.size());
  bytes_ += value;
}

void RowHash::add_null() { bytes_ += 'n'; }

void RowHash::end_row(TableDigest& digest) {
  ++digest.rows;
  digest.sum += hash_of(bytes_);
  bytes_.clear();
}

}  // namespace metamorph::evolve
