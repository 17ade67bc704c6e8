#pragma once

#include "evolve/genetics/population.h"
#include "metamorph/random.h"

namespace metamorph::evolve {

/// Topology of generation 0: every input to every hidden node, every hidden node to every output,
/// the bias to every output; nothing else. Inputs and outputs are those of the shape. Weights
/// triangular on +-settings.initial_weight. All seed genomes of a run share their innovation
/// numbers, 0 to links - 1.
Genome seed_genome(const NeatSettings& settings, RandomStream& stream,
                   const ControlShape& shape = {});

/// A weight as new links get it: triangular on +-settings.initial_weight, within the limit.
double new_weight(const NeatSettings& settings, RandomStream& stream);

}  // namespace metamorph::evolve
