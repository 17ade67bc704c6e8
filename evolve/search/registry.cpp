#include "metamorph/searches.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <stdexcept>
#include <type_traits>

namespace metamorph::evolve {

SearchKind simple_search();
SearchKind progressive_search();
SearchKind novelty_search();
SearchKind map_elites_search();
SearchKind nslc_search();
SearchKind dns_search();
SearchKind nsga2_search();

const std::vector<SearchKind>& search_kinds() {
  static const std::vector<SearchKind> kinds = {
      simple_search(), progressive_search(), novelty_search(), map_elites_search(),
      nslc_search(),   dns_search(),         nsga2_search()};
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
  std::string lines;
  for (const Contradiction& fault : faults(setup)) {
    lines += fmt::format("{}{}: expected {}", lines.empty() ? "" : "\n", fault.key, fault.expected);
  }
  if (!lines.empty()) throw std::invalid_argument(lines);
  SearchSetup complete = setup;
  complete.neat.stages = stage_count(setup.problem);
  return search_kind(setup.settings.kind).make(complete);
}

SearchSettings::SearchSettings() {
  for (const SearchKind& search : search_kinds()) {
    for (const Setting& setting : search.settings) {
      values.emplace(std::string(setting.name), setting.initial);
    }
  }
}

SearchSettings paper_search_settings() {
  SearchSettings settings;
  for (const SearchKind& search : search_kinds()) {
    for (const Setting& setting : search.settings) {
      if (setting.paper) settings.values.find(setting.name)->second = *setting.paper;
    }
  }
  return settings;
}

NeatSettings paper_neat_settings() {
  NeatSettings settings;
  for (const NeatField& field : neat_fields) {
    std::visit(
        [&](auto member) {
          auto& value = settings.*member;
          value = static_cast<std::remove_reference_t<decltype(value)>>(field.paper);
        },
        field.member);
  }
  return settings;
}

}  // namespace metamorph::evolve
