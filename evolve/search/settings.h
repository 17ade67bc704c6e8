#pragma once

#include <map>
#include <string>
#include <string_view>
#include <variant>

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

}  // namespace metamorph::evolve
