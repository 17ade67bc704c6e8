#include "evolve/search/origins.h"

#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace metamorph::evolve {

Table origins_table(bool entered) {
  using enum Table::Type;
  Table table = {"origins",
                 {{"generation", integer},
                  {"origin", text},
                  {"crossed", integer},
                  {"children", integer},
                  {"better", integer},
                  {"dead", integer}},
                 3};
  if (entered) table.columns.insert(table.columns.end() - 1, {"entered", integer});
  return table;
}

std::vector<Row> origin_rows(const PopulationState& population, std::span<const double> qualities,
                             std::span<const double> better_parents,
                             std::span<const std::uint8_t> lives_on) {
  struct Count {
    std::int64_t children = 0, better = 0, entered = 0, dead = 0;
  };
  std::map<std::pair<std::string_view, bool>, Count> counts;
  for (std::size_t i = 0; i < population.individuals.size(); ++i) {
    const Individual& child = population.individuals[i];
    Count& count =
        counts[{origin_names[static_cast<std::size_t>(child.origin)].name, child.parent_b >= 0}];
    ++count.children;
    count.better += child.parent_a >= 0 && qualities[i] > better_parents[i] ? 1 : 0;
    count.entered += !lives_on.empty() && lives_on[i] != 0 ? 1 : 0;
    count.dead += qualities[i] == 0 ? 1 : 0;
  }
  std::vector<Row> rows;
  for (const auto& [key, count] : counts) {
    Row row = {std::int64_t{population.generation},
               std::string(key.first),
               std::int64_t{key.second},
               count.children,
               count.better,
               count.dead};
    if (!lives_on.empty()) row.insert(row.end() - 1, count.entered);
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace metamorph::evolve
