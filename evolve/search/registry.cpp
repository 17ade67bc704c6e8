#include "metamorph/searches.h"

#include <algorithm>
#include <cassert>

namespace metamorph::evolve {

SearchKind simple_search();
SearchKind progressive_search();
SearchKind novelty_search();

const std::vector<SearchKind>& search_kinds() {
  static const std::vector<SearchKind> kinds = {simple_search(), progressive_search(),
                                                novelty_search()};
  return kinds;
}

const SearchKind& search_kind(std::string_view name) {
  const std::vector<SearchKind>& kinds = search_kinds();
  const auto found = std::find_if(kinds.begin(), kinds.end(),
                                  [&](const SearchKind& kind) { return kind.name == name; });
  assert(found != kinds.end());
  return *found;
}

std::unique_ptr<Search> make_search(const SearchSetup& setup) {
  return search_kind(setup.settings.kind).make(setup);
}

SearchSettings::SearchSettings() {
  for (const SearchKind& search : search_kinds()) {
    for (const Setting& setting : search.settings) {
      values.emplace(std::string(setting.name), setting.initial);
    }
  }
}

int SearchSettings::integer(std::string_view name) const {
  return std::get<int>(values.find(name)->second);
}

double SearchSettings::real(std::string_view name) const {
  return std::get<double>(values.find(name)->second);
}

}  // namespace metamorph::evolve
