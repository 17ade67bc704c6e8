#pragma once

#include <array>
#include <vector>

#include "metamorph/body.h"
#include "metamorph/scene.h"

namespace metamorph::core {

/// A node and an edge that must not pass through each other.
struct SolidPair {
  Index node = 0;
  std::array<Index, 2> edge{};  ///< the node is none of its ends
  double threshold = 0;         ///< the gap below which they repel, d
};

/// Every outline node against every outline edge of which it is no end, by edge, then node; and
/// then the corners_without_pressure(). Thresholds: the scene's collision_gap, or the distance at
/// rest where that is smaller.
std::vector<SolidPair> solid_pairs(const Body& body, const Scene& scene);

/// Each corner of a triangle too small for pressure against the side opposite to it, unless that is
/// a pair of the outline anyway: nothing but their distance keeps such a triangle from turning
/// over.
std::vector<SolidPair> corners_without_pressure(const Body& body, const Scene& scene);

}  // namespace metamorph::core
