#pragma once

#include <optional>
#include <span>

#include "metamorph/body.h"

namespace metamorph::core {

/// Where an outline crosses or touches itself, as an outcome tells it.
struct CrossedEdge {
  Index spring = -1;  ///< the outline edge, as a position in Body::springs
  Index node = -1;    ///< of an edge that meets it, the end that lies nearest to it
};

/// Of a body whose nodes are at x, y [nodes]; nothing if its outline does not meet itself. Exact.
std::optional<CrossedEdge> crossed_edge(const Body& body, std::span<const double> x,
                                        std::span<const double> y);

}  // namespace metamorph::core
