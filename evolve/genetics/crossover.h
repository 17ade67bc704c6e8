#pragma once

#include "evolve/genetics/genome.h"
#include "metamorph/random.h"

namespace metamorph::evolve {

/// Crosses two sound genomes. The child has the nodes and links of the fitter one; the weight of a
/// link that both have (same innovation number) comes from either with equal chance, or is their
/// mean if `averaging`. The structure is the fitter's, so a crossover cannot close a cycle.
Genome cross(const Genome& fitter, const Genome& other, bool averaging, RandomStream& stream);

}  // namespace metamorph::evolve
