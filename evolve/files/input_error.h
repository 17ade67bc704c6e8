#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace metamorph::evolve {

/// What a person gave cannot be used: one line per fault, each complete in itself
/// ("file: key: value: expected ..."). The program prints the lines and ends with exit code 2. What
/// no line can show of the names and values in them is escaped (printable.h).
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<std::string> lines);
  explicit InputError(const std::string& line) : InputError(std::vector{line}) {}

  const std::vector<std::string>& lines() const { return lines_; }

 private:
  std::vector<std::string> lines_;
};

/// Collects the faults of one file, so that all of them are told at once; of very many, the first.
class FaultList {
 public:
  /// `source` starts every line: the file's name, or what else the values came from.
  explicit FaultList(std::string source) : source_(std::move(source)) {}

  /// Adds "source: key: value: expected ...". `value` is the offending value, "missing", "unknown
  /// key" or the like, shortened if it is long; an empty key or value is left out.
  void add(std::string_view key, std::string_view value, std::string_view expected);

  /// Adds "source: text".
  void add_line(std::string_view text);

  bool empty() const { return lines_.empty(); }
  const std::string& source() const { return source_; }
  const std::vector<std::string>& lines() const { return lines_; }

  /// Throws InputError if there is a fault.
  void throw_if_any() const;

 private:
  std::string source_;
  std::vector<std::string> lines_;
  std::size_t untold_ = 0;
};

}  // namespace metamorph::evolve
