#pragma once

// Reading and writing of JSON, for the .cpp files of this folder.

#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "evolve/files/input_error.h"

namespace metamorph::evolve::detail {

using Json = nlohmann::json;

/// Parses text that must hold one JSON object. Throws InputError with the place of the fault:
/// syntax, an early end, a key given twice, nesting deeper than any of our formats.
Json parse_object(std::string_view text, const std::string& source);

/// Checks the tag of an object read from `faults.source()`; a wrong one ends the reading (throws
/// InputError, for nothing else in the file can be judged), a missing one is a fault like others.
void check_format(const Json& object, std::string_view format, FaultList& faults);

/// A value as a fault line shows it: scalars and short lists as they are, else what they are.
std::string shown(const Json& value);

/// The members of one object: which were asked for, which are left over.
class Members {
 public:
  /// `key` is the object's own place in the file ("" for the whole file, "nodes[3]", ...).
  Members(const Json& object, std::string key, FaultList& faults)
      : object_(object), key_(std::move(key)), faults_(faults) {}

  /// The member, or nullptr and a fault that it is missing.
  const Json* required(const std::string& name, std::string_view expected);

  const Json* optional(const std::string& name);

  /// The member's place in the file.
  std::string key_of(const std::string& name) const;

  /// A fault for every member that was never asked for.
  void no_others();

 private:
  const Json& object_;
  std::string key_;
  FaultList& faults_;
  std::vector<std::string> known_;
};

/// A number, or nullopt and a fault.
std::optional<double> as_number(const Json& value, const std::string& key, FaultList& faults,
                                double low = std::numeric_limits<double>::lowest(),
                                double high = std::numeric_limits<double>::max());

/// An integer, or nullopt and a fault.
std::optional<int> as_integer(const Json& value, const std::string& key, FaultList& faults,
                              int low = std::numeric_limits<int>::min(),
                              int high = std::numeric_limits<int>::max());

/// The elements of an array, or nullptr and a fault.
const Json::array_t* as_array(const Json& value, const std::string& key, std::string_view expected,
                              FaultList& faults);

/// "key[index]".
std::string element_key(std::string_view key, std::size_t index);

/// Appends the shortest text that reads back to the same number, its sign included.
void append_number(std::string& text, double value);

/// Appends "[" items "]" on one line; `append(text, item)` writes one item.
template <class Items, class Append>
void append_row(std::string& text, const Items& items, Append append) {
  text += '[';
  bool first = true;
  for (const auto& item : items) {
    if (!first) text += ", ";
    first = false;
    append(text, item);
  }
  text += ']';
}

/// Appends an array with one item per line, indented by `indent` + 2.
template <class Items, class Append>
void append_lines(std::string& text, const Items& items, std::size_t indent, Append append) {
  text += '[';
  bool first = true;
  for (const auto& item : items) {
    text.append(first ? "\n" : ",\n").append(indent + 2, ' ');
    first = false;
    append(text, item);
  }
  if (!first) text.append("\n").append(indent, ' ');
  text += ']';
}

inline void append_numbers(std::string& text, const std::vector<double>& values) {
  append_row(text, values, append_number);
}

}  // namespace metamorph::evolve::detail
