#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "evolve/genetics/population.h"
#include "metamorph/random.h"
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

/// A parent, by what a child of it depends on.
struct Mate {
  const Genome& genome;
  double fitness = 0;  ///< the fitter one leads; of equals the smaller genome, then the lower index
  int index = 0;
};

/// A child of two parents by crossover, after which it may mutate, or of one (b null) by mutation.
Child child_of(const Mate& a, const Mate* b, const NeatSettings& settings, RandomStream crossing,
               RandomStream mutation);

/// Breeds children 0 to count - 1 by child(index, attempt), a function of both numbers alone. One
/// that is identical to an earlier child or to one of the living is bred again, `tries` times at
/// most, unless it is meant to be a copy. The same result for any thread count.
std::vector<Child> breed_distinct(int count, int tries, int threads,
                                  const std::function<Child(int, int)>& child,
                                  const std::function<bool(int)>& is_copy,
                                  std::span<const Genome* const> living);

/// Breeds all children, in order of species, champions' copies first in each. A child (no copy)
/// identical to an earlier one is bred again, settings.clone_tries times at most. The same result
/// for any thread count.
std::vector<Child> breed(const PopulationState& state, const NeatSettings& settings,
                         std::span<const double> fitness, const std::vector<SpeciesPlan>& plans,
                         int threads);

}  // namespace metamorph::evolve
