#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "evolve/genetics/population.h"
#include "metamorph/variation.h"

namespace metamorph::evolve {

/// Splits `seats` in proportion to `shares` (finite, >= 0; all zero counts as all equal) by the
/// largest remainder, ties to the lower index. The parts add up to `seats`.
std::vector<int> apportion(std::span<const double> shares, int seats);

/// What a species does in the next generation.
struct SpeciesPlan {
  std::vector<int> parents;  ///< its best floor(share * n) + 1 members, champion first
  int offspring = 0;         ///< champion's copy included
};

/// Shared fitness of every species (the sum over its members of fitness / size, adjusted for age
/// and stagnation) turned into offspring numbers that add up to settings.population. The species
/// of the fittest individual is exempt from stagnation and has at least one child, its champion's
/// copy. `ranked` as from ranked_members().
std::vector<SpeciesPlan> plan_reproduction(const PopulationState& state,
                                           const NeatSettings& settings,
                                           std::span<const double> fitness,
                                           const std::vector<std::vector<int>>& ranked);

/// A child before its structural change has innovation numbers.
struct Child {
  Genome genome;
  StructuralChange change;
  int parent_a = -1, parent_b = -1;  ///< indices in the present generation; b -1: asexual
  Origin origin = Origin::copy;
};

/// Breeds all children, in order of species, champions' copies first in each. A child (no copy)
/// identical to an earlier one is bred again, settings.clone_tries times at most. The same result
/// for any thread count.
std::vector<Child> breed(const PopulationState& state, const NeatSettings& settings,
                         std::span<const double> fitness, const std::vector<SpeciesPlan>& plans,
                         int threads);

}  // namespace metamorph::evolve
