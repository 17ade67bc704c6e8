#include "evolve/files/input_error.h"

#include <utility>

#include "evolve/files/printable.h"

namespace metamorph::evolve {
namespace {

constexpr std::size_t longest_value = 60;
constexpr std::size_t most_lines = 100;  ///< of one file; nobody reads more

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines)
    text.append(text.empty() ? "" : "\n").append(printable(line));
  return text;
}

/// At most `longest_value` bytes, cut between characters of UTF-8, and on one line.
std::string shortened(std::string_view value) {
  std::string text(value.substr(0, longest_value));
  if (text.size() < value.size()) {
    std::size_t end = text.size();
    while (end > 0 && (static_cast<unsigned char>(value[end]) & 0xC0) == 0x80) --end;
    text.resize(end);
    text += "...";
  }
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = '?';
  }
  return text;
}

}  // namespace

InputError::InputError(std::vector<std::string> lines)
    : std::runtime_error(joined(lines)), lines_(std::move(lines)) {
  for (std::string& line : lines_) line = printable(line);
}

void FaultList::add(std::string_view key, std::string_view value, std::string_view expected) {
  std::string line;
  if (!key.empty()) line.append(shortened(key)).append(": ");
  if (!value.empty()) line.append(shortened(value)).append(": ");
  add_line(line.append("expected ").append(expected));
}

void FaultList::add_line(std::string_view text) {
  if (lines_.size() < most_lines) {
    lines_.push_back(std::string(source_).append(": ").append(text));
  } else {
    ++untold_;
  }
}

void FaultList::throw_if_any() const {
  if (lines_.empty()) return;
  std::vector<std::string> lines = lines_;
  if (untold_ > 0) lines.push_back(source_ + ": and " + std::to_string(untold_) + " more");
  throw InputError(std::move(lines));
}

}  // namespace metamorph::evolve
