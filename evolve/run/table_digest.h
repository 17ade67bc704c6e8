#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace metamorph::evolve {

/// What rows of a table amount to, in any order: tells damage, not malice.
struct TableDigest {
  std::int64_t rows = 0;
  std::uint64_t sum = 0;  ///< of the rows' hashes, modulo 2^64
  TableDigest& operator+=(const TableDigest& other);
  bool operator==(const TableDigest&) const = default;
};

/// Hashes one row, cell by cell in order of the columns. A whole number is the same in a column of
/// reals, and a zero has no sign, as in the record.
class RowHash {
 public:
  void add(std::int64_t value);
  void add(double value);  ///< NaN: as null
  void add(std::string_view value);
  void add_null();

  /// Counts the row in `digest` and begins the next one.
  void end_row(TableDigest& digest);

 private:
  std::string bytes_;
};

/// XXH3 of some bytes.
std::uint64_t hash_of(std::string_view bytes);

/// Appends a number in the byte order of every machine.
void append_bytes(std::string& bytes, std::uint64_t value);

}  // namespace metamorph::evolve
