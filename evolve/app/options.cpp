#include "evolve/app/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <system_error>
#include <utility>

namespace metamorph::evolve {
namespace {

struct SceneEntry {
  const char* name;
  core::Scene (*make)();
};
constexpr std::array<SceneEntry, 4> scenes = {{{"water", core::water_scene},
                                               {"land", core::land_scene},
                                               {"land-right", core::land_right_scene},
                                               {"slope", core::slope_scene}}};

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

/// An option that takes one of a few names for a value; `table` starts with the default.
template <class T, std::size_t size>
void add_choice(CLI::App& command, const std::string& option, T& value,
                const std::array<core::Named<T>, size>& table, const std::string& help) {
  std::vector<std::string> keys;
  for (const auto& entry : table) keys.emplace_back(entry.name);
  const auto set = [&value, &table](const std::string& chosen) {
    for (const auto& entry : table) {
      if (entry.name == chosen) value = entry.value;
    }
  };
  command.add_option_function<std::string>(option, set, help)
      ->check(one_of(keys))
      ->option_text(fmt::format("{} [{}]", fmt::join(keys, "|"), keys.front()));
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

void add_development_options(CLI::App& command, core::DevelopmentRules& rules, int& min_cells) {
  command.add_option("--steps-of-development", rules.steps, "Length of the whole development")
      ->check(integer_from(1, 1000000))
      ->option_text("STEPS [1200]")
      ->group("Development");
  command.add_option("--max-cells", rules.max_cells, "Most cells alive at one time")
      ->check(integer_from(1, 100000))
      ->option_text("N [256]")
      ->group("Development");
  command.add_option("--min-cells", min_cells, "Fewest cells of a body")
      ->check(integer_from(3, 100000))
      ->option_text("N [8]")
      ->group("Development");
}

void add_locomotion_options(CLI::App& command, core::LocomotionOptions& options) {
  add_choice(command, "--method", options.method, core::method_names, "Integrator");
  add_choice(command, "--precision", options.precision, core::precision_names, "Arithmetic");
}

void add_scene_option(CLI::App& command, std::string& name) {
  std::vector<std::string> names;
  for (const SceneEntry& entry : scenes) names.push_back(entry.name);
  command.add_option("--scene", name, "Environment")
      ->check(one_of(names))
      ->option_text(fmt::format("{} [{}]", fmt::join(names, "|"), name));
}

core::Scene scene_named(const std::string& name) {
  const auto entry = std::find_if(scenes.begin(), scenes.end(),
                                  [&](const SceneEntry& scene) { return scene.name == name; });
  assert(entry != scenes.end());
  return entry->make();
}

}  // namespace metamorph::evolve
