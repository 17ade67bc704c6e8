#pragma once

#include <limits>
#include <vector>

#include "metamorph/genome.h"

namespace metamorph::evolve {

/// The links of a genome as two flat arrays, ascending by innovation: what the distance reads.
struct LinkArrays {
  std::vector<int> innovation;  ///< [links]
  std::vector<double> weight;   ///< [links]
  std::vector<Stages> stages;   ///< [links], or empty: all are expressed in all of them
};

LinkArrays link_arrays(const Genome& genome);

/// Compatibility distance of two genomes: number of links that only one of them has (excess and
/// disjoint alike), or has in other stages of life, + factor * mean |weight difference| of the
/// links they share (0 if none). Symmetric. As soon as the count alone reaches `limit` that count
/// is returned: enough to know that the distance is not below the limit.
double distance(const LinkArrays& a, const LinkArrays& b, double factor,
                double limit = std::numeric_limits<double>::infinity());

double distance(const Genome& a, const Genome& b, double factor);

}  // namespace metamorph::evolve
