#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "evolve/genetics/population.h"
#include "metamorph/random.h"
#include "metamorph/searches.h"

// What searches without species breed: a generation that is about to be evaluated is a
// PopulationState whose individuals are in no species.

namespace metamorph::evolve {

/// The seed genomes, as those of NEAT.
PopulationState first_brood(const SearchSetup& setup);

/// One that may have children; borrows the genome.
struct Parent {
  std::int64_t id = 0;
  const Genome* genome = nullptr;
  double quality = 0;  ///< the better one leads in crossover
};

/// Draws a parent's index.
using ParentChoice = std::function<std::size_t(RandomStream&)>;

/// Replaces a brood by the next generation: settings.population children, each of one parent drawn
/// by `choose` or, with probability settings.crossover, of two, if the second one drawn is not the
/// first again. Varied as NEAT's children are; one identical to an earlier child or to a parent is
/// bred again. The parents' genomes may be the brood's own. The same bits for any number of
/// threads. Precondition: there is a parent.
void breed_from(std::span<const Parent> parents, const ParentChoice& choose,
                const NeatSettings& settings, int threads, PopulationState& brood);

/// What a search asks for: the whole brood, every objective measured.
Asked asked_of(const PopulationState& brood, const Problem& problem);

/// Throws std::invalid_argument unless there is one evaluation per individual of the brood, each
/// with the problem's objectives and its descriptors or none.
void check_told(std::span<const Evaluation> evaluations, const PopulationState& brood,
                const Problem& problem);

/// Throws std::runtime_error unless a loaded brood is one of this size and seed.
void check_brood(const PopulationState& brood, const NeatSettings& settings,
                 const Problem& problem);

/// Individuals of a brood by how they came to be: how many there were, lived on, had no quality.
extern const Table origins_table;
std::vector<Row> origin_rows(const PopulationState& brood, std::span<const std::uint8_t> lives_on,
                             std::span<const double> qualities);

}  // namespace metamorph::evolve
