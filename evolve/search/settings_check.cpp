// What keeps a search from being made.

#include "evolve/search/settings_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>
#include <type_traits>

#include "metamorph/genome.h"

namespace metamorph::evolve {
namespace {

std::string range_text(double low, double high) {
  return high >= no_limit ? fmt::format("at least {}", low)
                          : fmt::format("from {} to {}", low, high);
}

bool within(double value, double low, double high) {
  return std::isfinite(value) && value >= low && value <= high;
}

template <class Number>
void at_most(std::vector<Contradiction>& found, const std::string& low_key, Number low,
             const std::string& high_key, Number high) {
  if (low > high) found.push_back({low_key, fmt::format("at most {} = {}", high_key, high)});
}

void check_neat(const NeatSettings& neat, std::vector<Contradiction>& found) {
  bool in_range = true;
  for (const NeatField& field : neat_fields) {
    const double value =
        std::visit([&](auto member) { return static_cast<double>(neat.*member); }, field.member);
    if (within(value, field.low, field.high)) continue;
    in_range = false;
    found.push_back({fmt::format("neat.{}", field.name),
                     fmt::format("a number {}", range_text(field.low, field.high))});
  }
  if (!in_range) return;
  at_most(found, "neat.species_min", neat.species_min, "neat.species_max", neat.species_max);
  at_most(found, "neat.compatibility_floor", neat.compatibility_floor,
          "neat.compatibility_threshold", neat.compatibility_threshold);
  at_most(found, "neat.initial_weight", neat.initial_weight, "neat.weight_limit",
          neat.weight_limit);
  if (neat.mutate_weights <= 0) {
    // A genome may have nothing to remove, no link to add and none to split; a roulette without
    // weight changes could then draw for ever.
    found.push_back({"neat.mutate_weights", "more than 0: the other mutations can all fail"});
  }
}

void check_values(const SearchSettings& settings, std::vector<Contradiction>& found) {
  std::set<std::string_view> checked;
  for (const SearchKind& kind : search_kinds()) {
    for (const Setting& setting : kind.settings) {
      if (!checked.insert(setting.name).second) continue;  // of another kind, too
      const std::string key = fmt::format("search.{}", setting.name);
      const auto value = settings.values.find(setting.name);
      if (value == settings.values.end() || value->second.index() != setting.initial.index()) {
        found.push_back({key, "a value of the type that it has initially"});
        continue;
      }
      const auto check_number = [&](double number) {
        if (within(number, setting.low, setting.high)) return true;
        found.push_back({key, fmt::format("a number {}", range_text(setting.low, setting.high))});
        return false;
      };
      if (const int* number = std::get_if<int>(&value->second)) check_number(*number);
      if (const double* number = std::get_if<double>(&value->second)) check_number(*number);
      if (const auto* numbers = std::get_if<std::vector<double>>(&value->second)) {
        for (const double number : *numbers) {
          if (!check_number(number)) break;
        }
      }
    }
  }
  for (const auto& [name, value] : settings.values) {
    const auto has = [&](const SearchKind& kind) {
      return std::any_of(kind.settings.begin(), kind.settings.end(),
                         [&](const Setting& setting) { return setting.name == name; });
    };
    if (std::none_of(search_kinds().begin(), search_kinds().end(), has)) {
      found.push_back({"search." + name, "a setting of some search"});
    }
  }
}

void check_problem(const Problem& problem, std::vector<Contradiction>& found) {
  if (problem.objectives.empty()) {
    found.push_back({"problem.objectives", "one at least"});
  }
  for (const Descriptor& d : problem.descriptors) {
    if (d.objective < 0 || static_cast<std::size_t>(d.objective) >= problem.objectives.size() ||
        !(d.low < d.high)) {
      found.push_back({"problem.descriptors." + d.name, "an objective of the problem, low < high"});
    }
  }
}

void check_separation(const SearchSetup& setup, std::vector<Contradiction>& found) {
  if (setup.neat.separation == Separation::none || stage_count(setup.problem) > 1) return;
  found.push_back({"neat.separation", "none: life has one stage, so nothing can be separated"});
}

void check_shape(const ControlShape& shape, std::vector<Contradiction>& found) {
  const auto all_are = [](const std::vector<int>& ids, NodeKind kind) {
    std::vector<int> sorted = ids;
    std::sort(sorted.begin(), sorted.end());
    return std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end() &&
           std::all_of(ids.begin(), ids.end(), [&](int id) { return kind_of(id) == kind; });
  };
  if (!all_are(shape.inputs, NodeKind::input) ||
      std::find(shape.inputs.begin(), shape.inputs.end(), bias_input) == shape.inputs.end()) {
    found.push_back({"shape.inputs", "inputs, each once, the bias among them"});
  }
  if (!all_are(shape.outputs, NodeKind::output) || shape.outputs.empty()) {
    found.push_back({"shape.outputs", "one output or more, each once"});
  }
}

}  // namespace

std::vector<Contradiction> unknown_descriptors(const std::string& key,
                                               const std::vector<std::string>& names,
                                               const SearchSetup& setup) {
  std::vector<std::string> known;
  for (const Descriptor& d : setup.problem.descriptors) known.push_back(d.name);
  std::vector<Contradiction> found;
  for (const std::string& name : names) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    found.push_back(
        {key, fmt::format("none but {} (\"{}\" is unknown)", fmt::join(known, ", "), name)});
  }
  return found;
}

std::vector<Contradiction> faults(const SearchSetup& setup) {
  std::vector<Contradiction> found;
  check_neat(setup.neat, found);
  check_values(setup.settings, found);
  check_problem(setup.problem, found);
  check_separation(setup, found);
  check_shape(setup.shape, found);
  const auto& kinds = search_kinds();
  const auto kind = std::find_if(kinds.begin(), kinds.end(), [&](const SearchKind& k) {
    return k.name == setup.settings.kind;
  });
  if (kind == kinds.end()) {
    std::vector<std::string_view> names;
    for (const SearchKind& k : kinds) names.push_back(k.name);
    found.push_back({"search.kind", fmt::format("one of {}", fmt::join(names, ", "))});
  } else if (found.empty() && kind->contradictions != nullptr) {
    found = kind->contradictions(setup);
  }
  return found;
}

}  // namespace metamorph::evolve
