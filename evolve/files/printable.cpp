#include "evolve/files/printable.h"

#include <cstddef>

namespace metamorph::evolve {
namespace {

/// Bytes of the character of UTF-8 that the text begins with; 0 if it is none, or a control.
std::size_t character_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(0);
  if (first < 0x80) return first >= ' ' && first != 0x7f ? 1 : 0;
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < length) return 0;
  unsigned long code = first & (0x7fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
    code = code << 6 | (byte(i) & 0x3fu);
  }
  const bool longer_than_needed = code < (length == 3 ? 0x800u : length == 4 ? 0x10000u : 0);
  const bool half_of_a_pair = code >= 0xd800 && code <= 0xdfff;
  const bool control = code < 0xa0;
  return longer_than_needed || half_of_a_pair || control || code > 0x10ffff ? 0 : length;
}

}  // namespace

std::string printable(std::string_view text) {
  constexpr char digits[] = "0123456789abcdef";
  std::string result;
  while (!text.empty()) {
    std::size_t length = character_length(text);
    if (length > 0) {
      result += text.substr(0, length);
    } else {
      const auto byte = static_cast<unsigned char>(text[0]);
      result.append("\\x").append({digits[byte >> 4], digits[byte & 15]});
      length = 1;
    }
    text.remove_prefix(length);
  }
  return result;
}

}  // namespace metamorph::evolve
