#pragma once

// What a test may say of an SVG file without a library for XML.

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace metamorph::tests {

struct Svg {
  std::string fault;    ///< why it is no well-formed XML with a root svg; empty if it is
  int drawn_paths = 0;  ///< <path> with a line or a curve in it, outside <defs>
};

namespace detail {

/// Reads one document, tag by tag.
class SvgReader {
 public:
  explicit SvgReader(std::string_view text) : left_(text) {}

  Svg read() {
    if (!skip("<?xml ") || !skip_past("?>")) fail("no XML declaration");
    while (svg_.fault.empty() && !left_.empty()) {
      if (left_.starts_with("<!--")) {
        if (!skip_past("-->")) fail("comment without end");
      } else if (left_.front() == '<') {
        tag();
      } else {
        characters();
      }
    }
    if (!open_.empty()) fail("<" + open_.back() + "> is not closed");
    if (roots_ != 1) fail("not one root");
    return svg_;
  }

 private:
  void fail(const std::string& why) {
    if (svg_.fault.empty()) svg_.fault = why;
  }
  bool skip(std::string_view text) {
    if (!left_.starts_with(text)) return false;
    left_.remove_prefix(text.size());
    return true;
  }
  bool skip_past(std::string_view text) {
    const std::size_t at = left_.find(text);
    left_.remove_prefix(at == left_.npos ? left_.size() : at + text.size());
    return at != left_.npos;
  }
  std::string_view take_while(auto&& wanted) {
    const auto end = std::find_if_not(left_.begin(), left_.end(), wanted);
    const auto size = static_cast<std::size_t>(end - left_.begin());
    const std::string_view taken = left_.substr(0, size);
    left_.remove_prefix(size);
    return taken;
  }
  static bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }
  static bool is_name(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == ':' || c == '-' || c == '_';
  }

  /// Every & of a text or a value must begin a reference.
  void references(std::string_view text) {
    for (std::size_t at = text.find('&'); at != text.npos; at = text.find('&', at + 1)) {
      const std::size_t end = text.find(';', at);
      if (end == text.npos || end == at + 1 || end > at + 10) fail("& that begins no reference");
    }
  }

  void characters() {
    const std::string_view text = take_while([](char c) { return c != '<'; });
    references(text);
    if (open_.empty() && !std::all_of(text.begin(), text.end(), is_space)) fail("text beside root");
  }

  void tag() {
    skip("<");
    if (skip("/")) {
      const std::string name(take_while(is_name));
      take_while(is_space);
      if (!skip(">")) fail("</" + name + " without end");
      if (open_.empty() || open_.back() != name) return fail("</" + name + "> closes nothing");
      open_.pop_back();
      return;
    }
    const std::string name(take_while(is_name));
    if (name.empty()) return fail("< that begins no tag");
    if (open_.empty()) {
      ++roots_;
      if (name != "svg") fail("the root is <" + name + ">");
    }
    std::vector<std::string> seen;
    std::string_view path;
    for (;;) {
      const bool space = !take_while(is_space).empty();
      if (skip("/>")) break;
      if (skip(">")) {
        open_.push_back(name);
        break;
      }
      const std::string attribute(take_while(is_name));
      if (!space || attribute.empty() || !skip("=\"")) return fail("attribute of <" + name + ">");
      const std::string_view value = take_while([](char c) { return c != '"' && c != '<'; });
      if (!skip("\"")) return fail(attribute + " of <" + name + "> has no end");
      references(value);
      if (std::count(seen.begin(), seen.end(), attribute) > 0) fail("two " + attribute);
      seen.push_back(attribute);
      if (attribute == "d") path = value;
    }
    const bool defines = std::count(open_.begin(), open_.end(), "defs") > 0;
    if (name == "path" && !defines && path.find_first_of("LC") != path.npos) ++svg_.drawn_paths;
  }

  std::string_view left_;
  std::vector<std::string> open_;
  int roots_ = 0;
  Svg svg_;
};

}  // namespace detail

inline Svg read_svg(std::string_view text) { return detail::SvgReader(text).read(); }

}  // namespace metamorph::tests
