#pragma once

#include <string>
#include <vector>

#include "metamorph/searches.h"

namespace metamorph::tests {

/// A search for four individuals, with an objective for each of `stages`.
inline evolve::SearchSetup setup_of(const std::string& kind, const std::vector<int>& stages,
                                    int generations) {
  evolve::SearchSetup setup;
  setup.settings.kind = kind;
  setup.neat.population = 4;
  for (const int stage : stages) setup.problem.objectives.push_back({"o", stage});
  setup.problem.descriptors = {{"o.x", 0, -9, 9}, {"o.y", 0, -9, 9}};
  setup.settings.values["axes"] = std::vector<std::string>{"o.x", "o.y"};
  setup.problem.generations = generations;
  setup.threads = 1;
  return setup;
}

}  // namespace metamorph::tests
