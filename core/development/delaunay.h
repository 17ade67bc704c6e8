#pragma once

#include <array>
#include <span>
#include <vector>

#include "metamorph/body.h"

namespace metamorph::core {

/// The Delaunay triangulation of a set of points, by exact predicates. Cocircular points are
/// resolved by a symbolic perturbation in the lexicographic order of the points, so that the result
/// is unique and depends on the coordinates alone. Points on one straight line have no faces;
/// consecutive ones share an edge. Of coincident points only the one of lowest index takes part;
/// each of the others has one edge, of length 0, to it.
struct Triangulation {
  std::vector<std::array<Index, 2>> edges;  ///< i < j, ascending
  std::vector<std::array<Index, 3>> faces;  ///< counter-clockwise, lowest index first, ascending
};

/// Triangulates points with finite coordinates.
void triangulate(std::span<const double> x, std::span<const double> y, Triangulation& result);

}  // namespace metamorph::core
