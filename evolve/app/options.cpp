#include "evolve/app/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <system_error>
#include <utility>

namespace metamorph::evolve {
namespace {

/// The whole text as a number of type T within limits, or what was expected.
template <class T>
CLI::Validator number_check(T low, T high, const char* kind, const std::string& or_word = "") {
  return CLI::Validator(
      [=](const std::string& text) {
        if (!or_word.empty() && text == or_word) return std::string();
        T value{};
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool good = error == std::errc() && end == text.data() + text.size();
        if (good && value >= low && value <= high) return std::string();
        return fmt::format("{}: expected {} from {} to {}{}", text, kind, low, high,
                           or_word.empty() ? "" : " or " + or_word);
      },
      "");
}

}  // namespace

CLI::Validator one_of(std::vector<std::string> names) {
  return CLI::Validator(
      [names = std::move(names)](const std::string& text) {
        if (std::find(names.begin(), names.end(), text) != names.end()) return std::string();
        const auto last = names.end() - 1;
        return fmt::format("{}: expected {} or {}", text, fmt::join(names.begin(), last, ", "),
                           *last);
      },
      "");
}

CLI::Validator integer_from(int low, int high) { return number_check(low, high, "an integer"); }

CLI::Validator number_from(double low, double high, std::string or_word) {
  return number_check(low, high, "a number", or_word);
}

}  // namespace metamorph::evolve
