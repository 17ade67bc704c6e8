#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "evolve/genetics/population.h"

namespace metamorph::evolve::testing {

/// What a rule gives each individual.
inline std::vector<double> each(const PopulationState& state,
                                const std::function<double(std::size_t)>& value) {
  std::vector<double> fitness;
  for (std::size_t i = 0; i < state.genomes.size(); ++i) fitness.push_back(value(i));
  return fitness;
}

/// Grows as weights come near a pattern: something that evolution can improve.
inline std::vector<double> pattern_fitness(const PopulationState& state) {
  return each(state, [&](std::size_t i) {
    double error = 0;
    for (const LinkGene& link : state.genomes[i].links) {
      error += std::abs(link.weight - (link.innovation % 5 - 2));
    }
    return 10 / (1 + error);
  });
}

}  // namespace metamorph::evolve::testing
