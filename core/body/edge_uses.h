#pragma once

#include <array>
#include <vector>

#include "metamorph/body.h"

namespace metamorph::core {

/// One side of one triangle.
struct EdgeUse {
  Index low = 0, high = 0;  ///< nodes of the edge, low < high
  Index triangle = 0;
  int side = 0;  ///< 0-2: the side from corner `side` to the next corner

  bool same_edge(const EdgeUse& other) const { return low == other.low && high == other.high; }
};

/// The sides of all triangles, ascending by (low, high), those of one edge by triangle. In linear
/// time: a radix sort, for this runs once per evaluated animat. Indices must be >= 0.
std::vector<EdgeUse> sorted_edge_uses(const std::vector<std::array<Index, 3>>& triangles);

/// The position after the run of uses of one edge that starts at `first`.
inline std::size_t end_of_edge(const std::vector<EdgeUse>& uses, std::size_t first) {
  std::size_t last = first + 1;
  while (last < uses.size() && uses[last].same_edge(uses[first])) ++last;
  return last;
}

}  // namespace metamorph::core
