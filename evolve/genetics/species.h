#pragma once

#include <span>
#include <vector>

#include "evolve/genetics/population.h"

namespace metamorph::evolve {

/// Members of every species of the state (indices of individuals), fittest first, ties by index.
std::vector<std::vector<int>> ranked_members(const PopulationState& state,
                                             std::span<const double> fitness);

/// Notes this generation's best fitness in every species: a new best ends its stagnation.
void record_best(std::vector<Species>& species, const std::vector<std::vector<int>>& ranked,
                 std::span<const double> fitness, bool restart_records);

/// Lowers the threshold by one step below settings.species_min species, raises it above
/// settings.species_max; never below the floor. Both are at most population / species_members, but
/// 1 at least: where every species keeps a copy of its champion, many small ones leave no seats for
/// children.
double adapted_threshold(double threshold, int species, const NeatSettings& settings);

/// Puts every genome into the first species whose representative is nearer than the threshold; one
/// that fits nowhere founds a species and represents it. Sets sizes and the individuals' species,
/// drops species without a member and returns their ids. The same result for any thread count.
std::vector<int> place_in_species(PopulationState& state, const NeatSettings& settings,
                                  int threads);

}  // namespace metamorph::evolve
