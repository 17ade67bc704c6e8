#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <vector>

#include "evolve/genetics/population.h"
#include "metamorph/random.h"
#include "metamorph/searches.h"

// What searches without species breed: PopulationStates whose individuals are in no species.

namespace metamorph::evolve {

/// A generation about to be evaluated.
struct Brood {
  PopulationState state;
  std::vector<double> parents;  ///< [population] quality of the better parent, -1 without any
};

/// The seed genomes, as those of NEAT.
Brood first_brood(const SearchSetup& setup);

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
                const NeatSettings& settings, int threads, Brood& brood);

/// What a search asks for: the whole brood, every objective measured.
Asked asked_of(const Brood& brood, const Problem& problem);

/// For any search: throws std::invalid_argument unless there is one evaluation per individual, each
/// with the problem's objectives and its descriptors or none.
void check_told(std::span<const Evaluation> evaluations, std::size_t individuals,
                const Problem& problem);

/// For checkpoints. The inverse throws nlohmann's exceptions, or std::runtime_error if the brood is
/// not of this size and seed.
nlohmann::json to_json(const Brood& brood);
Brood brood_of(const nlohmann::json& json, const NeatSettings& settings, const Problem& problem);

}  // namespace metamorph::evolve
