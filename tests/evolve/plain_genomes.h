#pragma once

#include "metamorph/genome.h"

namespace metamorph::tests {

/// A genome without links: every output is 0, so no cell dies, all divide along the mean
/// orientation of their neighbours, and the embryo is a row of cells along the x axis.
inline evolve::Genome row_genome() {
  evolve::Genome genome;
  for (int id = 0; id < evolve::first_hidden; ++id) {
    genome.nodes.push_back({id, evolve::kind_of(id).value()});
  }
  return genome;
}

/// As above, but the angle depends on the birth place: cells turn and fill the plane.
inline evolve::Genome blob_genome() {
  evolve::Genome genome = row_genome();
  genome.links = {{1, 0, 7, 6.0}, {2, 1, 7, 5.0},  {3, 2, 7, -4.0},
                  {4, 5, 7, 1.0}, {5, 1, 11, 3.0}, {6, 2, 12, 3.0}};
  return genome;
}

}  // namespace metamorph::tests
