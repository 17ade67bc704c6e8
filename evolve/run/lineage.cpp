#include "evolve/run/lineage.h"

#include <unordered_map>
#include <utility>

#include "evolve/run/sqlite.h"

namespace metamorph::evolve {

std::vector<GenerationFitness> fitness_of(Database& record) {
  std::vector<GenerationFitness> fitness;
  Statement select(record, "SELECT best_eq6, mean_eq6 FROM generations ORDER BY generation");
  while (select.step()) fitness.push_back({select.real(0), select.real(1)});
  return fitness;
}

std::map<std::int64_t, Ancestor> ancestors_of(Database& record,
                                              const std::vector<std::int64_t>& individuals) {
  // One look at the table, which has no index by individual. Who lives on is there again.
  std::unordered_map<std::int64_t, Ancestor> known;
  Statement select(record,
                   "SELECT id, generation, parent_a, parent_b, eq6 FROM individuals "
                   "ORDER BY generation, position");
  while (select.step()) {
    known.try_emplace(select.integer(0),
                      Ancestor{static_cast<int>(select.integer(1)), select.real(4),
                               select.integer(2), select.integer(3)});
  }
  const auto eq6 = [&](std::int64_t id) {
    const auto found = known.find(id);
    return found == known.end() ? -1.0 : found->second.eq6;
  };
  std::map<std::int64_t, Ancestor> ancestors;
  for (std::int64_t id : individuals) {
    for (auto found = known.find(id); found != known.end(); found = known.find(id)) {
      Ancestor ancestor = found->second;
      if (eq6(ancestor.other) > eq6(ancestor.parent)) std::swap(ancestor.parent, ancestor.other);
      if (!ancestors.emplace(id, ancestor).second) break;
      id = ancestor.parent;
    }
  }
  return ancestors;
}

}  // namespace metamorph::evolve
