#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "evolve/genetics/population.h"
#include "metamorph/searches.h"

// The table "origins": individuals by how they came to be (evolve/genetics/population.h) and
// whether a crossover came first.

namespace metamorph::evolve {

/// How many there were, were better than both parents, or dead; where individuals compete with
/// their parents for a place, how many of them entered, too.
Table origins_table(bool entered);

/// Its rows for one generation. qualities, [population], are 0 of the dead; better_parents,
/// [population], are -1 without any; lives_on, [population], is empty where nobody enters.
std::vector<Row> origin_rows(const PopulationState& population, std::span<const double> qualities,
                             std::span<const double> better_parents,
                             std::span<const std::uint8_t> lives_on);

}  // namespace metamorph::evolve
