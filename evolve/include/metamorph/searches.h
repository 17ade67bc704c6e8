#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "metamorph/control_shape.h"
#include "metamorph/neat_settings.h"
#include "metamorph/search.h"

// The searches there are, and how one is made.

namespace metamorph::evolve {

/// The value of a setting: a switch, a number, some numbers, or some names.
using SettingValue = std::variant<bool, int, double, std::vector<double>, std::vector<std::string>>;

/// One setting of a search, which an experiment sets as [search] NAME.
struct Setting {
  std::string_view name;
  SettingValue initial;
  double low = 0, high = 0;    ///< of a number, and of each of some numbers, both ends included
  std::string_view help = {};  ///< what it is, with its unit
  std::optional<SettingValue> paper = {};  ///< what the paper's search has, where that differs
};

/// Which search, and the settings of all searches there are.
struct SearchSettings {
  SearchSettings();  ///< simple search; every setting as it is initially

  std::string kind = "simple";
  std::map<std::string, SettingValue, std::less<>> values;

  /// Precondition: some search has a setting of that name and type.
  template <class Value>
  const Value& get(std::string_view name) const {
    return std::get<Value>(values.find(name)->second);
  }
};

/// Every setting as the paper has it (what the paper does not have stays as it is initially).
SearchSettings paper_search_settings();

/// Two settings that are each in range but exclude each other, or the problem.
struct Contradiction {
  std::string key;       ///< full path of the key to blame, as in neat.species_min
  std::string expected;  ///< what its value had to be, and why
};

/// What a search is made from.
struct SearchSetup {
  SearchSettings settings;
  NeatSettings neat;
  Problem problem;
  ControlShape shape;  ///< of the genomes' networks
  int threads = 0;     ///< 0: all
};

/// A kind of search. A new one costs its file, which defines one of these, and a line in
/// registry.cpp.
struct SearchKind {
  std::string_view name;  ///< [search] kind
  std::string_view help;
  std::vector<Setting> settings;  ///< of the same name in two kinds: the same in both
  std::unique_ptr<Search> (*make)(const SearchSetup& setup);
  std::vector<Contradiction> (*contradictions)(const SearchSetup& setup) = nullptr;  ///< may be 0
  /// What a person should know of a setup that works, but not as it says, one line each; may be 0.
  std::vector<std::string> (*notes)(const SearchSetup& setup) = nullptr;
  bool keeps_pool = false;  ///< neat.population parents live on beside as many children
};

/// All kinds.
const std::vector<SearchKind>& search_kinds();
/// Precondition: there is a kind of that name.
const SearchKind& search_kind(std::string_view name);

/// All that keeps a search from being made: no such kind, a setting that is unknown, of another
/// type or out of its range, a problem without an objective, a shape without the bias or an output,
/// descriptors that belong to no objective, what contradicts something else. Empty if nothing does.
std::vector<Contradiction> faults(const SearchSetup& setup);

/// Throws std::invalid_argument with all faults, one line each.
std::unique_ptr<Search> make_search(const SearchSetup& setup);

}  // namespace metamorph::evolve
