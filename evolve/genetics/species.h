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

/// The numbers of species between which the threshold stays: settings.species_min and species_max,
/// bounded by population / species_members, but 1 at least. Where every species keeps a copy of its
/// champion, many small ones leave no seats for children.
struct SpeciesRange {
  int min, max;
};
SpeciesRange species_range(const NeatSettings& settings);

/// Lowers the threshold by one step below that range, raises it above; never below the floor.
double adapted_threshold(double threshold, int species, const NeatSettings& settings);

/// Puts every genome into the first species whose representative is nearer than the threshold; one
/// that fits nowhere founds a species and represents it. Sets sizes and the individuals' species,
/// drops species without a member and returns their ids. The same result for any thread count.
std::vector<int> place_in_species(PopulationState& state, const NeatSettings& settings,
                                  int threads);

}  // namespace metamorph::evolve
