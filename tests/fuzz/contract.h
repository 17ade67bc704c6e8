#pragma once

// What every reader promises, whatever it is given: it takes an input, or throws InputError with
// lines that a terminal can show. Anything else ends the program, which is how a fuzz target says
// that it found something.

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "evolve/files/input_error.h"

namespace metamorph::fuzz {

inline constexpr std::size_t longest_line = 1000;  ///< bytes of a fault; a few lines of a terminal

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Ends the program unless it is so.
inline void require(bool so, std::string_view what, std::string_view shown = {}) {
  if (so) return;
  fmt::print(stderr, "broken: {}: {}\n", what, shown);
  std::abort();
}

/// Requires lines, each of bounded length, free of control characters, that begin with `source`.
inline void require_lines(const evolve::InputError& error, std::string_view source) {
  require(!error.lines().empty(), "an error says something");
  for (const std::string& line : error.lines()) {
    require(line.starts_with(source), "a line names its source", line);
    require(line.size() <= source.size() + longest_line, "a line has bounded length", line);
    require(std::none_of(line.begin(), line.end(),
                         [](unsigned char c) { return c < ' ' || c == 0x7f; }),
            "a line has no control characters", line);
  }
}

/// Whether the input is taken, as `read` does unless it throws InputError.
template <class Read>
bool is_taken(std::string_view source, Read read) {
  try {
    read();
  } catch (const evolve::InputError& error) {
    require_lines(error, source);
    return false;
  }
  return true;
}

}  // namespace metamorph::fuzz
