#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "metamorph/body.h"

namespace metamorph::core {

/// Distance of a node from an edge between two others, which are not at one place, d. x, y [nodes].
inline double distance_from_edge(std::span<const double> x, std::span<const double> y, Index node,
                                 const std::array<Index, 2>& edge) {
  const auto p = static_cast<std::size_t>(node), a = static_cast<std::size_t>(edge[0]),
             b = static_cast<std::size_t>(edge[1]);
  const double ex = x[b] - x[a], ey = y[b] - y[a], px = x[p] - x[a], py = y[p] - y[a];
  const double share = std::clamp((px * ex + py * ey) / (ex * ex + ey * ey), 0.0, 1.0);
  return std::hypot(px - share * ex, py - share * ey);
}

}  // namespace metamorph::core
