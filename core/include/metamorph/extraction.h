#pragma once

#include "metamorph/body.h"
#include "metamorph/development.h"
#include "metamorph/status.h"

namespace metamorph::core {

/// A body, or why there is none.
struct Extraction {
  Status status = Status::ok;  ///< ok, empty, no_body or bad_development
  Body body;                   ///< sound iff status is ok; rest lengths and areas set
};

/// The soft body of an embryo (MODEL section 3): Delaunay faces that cannot be reached from outside
/// without crossing a link, protrusions dropped, the largest edge-connected set of triangles (by
/// cells, ties by lowest cell index) kept; at least `min_cells` nodes.
Extraction extract_body(const Embryo& embryo, int min_cells = 8);

}  // namespace metamorph::core
