#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "metamorph/control_shape.h"
#include "metamorph/neat_settings.h"
#include "metamorph/search.h"

// The searches there are, and how one is made.

namespace metamorph::evolve {

/// One number of a search that an experiment may set, as [search] NAME.
struct Setting {
  std::string_view name;
  std::variant<int, double> initial;
  double low, high;       ///< both ends included
  std::string_view help;  ///< what it is, with its unit
};

/// Which search, and the numbers of all searches there are.
struct SearchSettings {
  SearchSettings();  ///< simple search; every setting as it is initially

  std::string kind = "simple";
  std::map<std::string, std::variant<int, double>, std::less<>> values;

  /// Precondition: some search has a setting of that name and type.
  int integer(std::string_view name) const;
  double real(std::string_view name) const;
};

/// Two settings that are each in range but exclude each other, or the problem.
struct Contradiction {
  std::string key;       ///< full path of the key to blame
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
};

/// All kinds.
const std::vector<SearchKind>& search_kinds();
/// Precondition: there is a kind of that name.
const SearchKind& search_kind(std::string_view name);

/// Precondition: the kind finds no contradiction.
std::unique_ptr<Search> make_search(const SearchSetup& setup);

}  // namespace metamorph::evolve
