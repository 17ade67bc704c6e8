#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "kernels/reference/views.h"

namespace metamorph::kernels::reference {

/// A node and an edge that must not pass through each other.
struct CollisionPair {
  int node;
  Edge edge;         ///< the node is none of its ends
  double threshold;  ///< gap below which they repel
};

/// The point of an edge that is closest to a node: its place along the edge (0 at the first end, 1
/// at the second), and the vector from it to the node.
struct ClosestPoint {
  double place = 0;
  double dx = 0, dy = 0;
  double gap = 0;
};

inline ClosestPoint closest_point(int node, const Edge& edge, std::span<const double> x,
                                  std::span<const double> y) {
  const auto [a, b, n] = places<3>({edge[0], edge[1], node});
  const double ex = x[b] - x[a];
  const double ey = y[b] - y[a];
  const double px = x[n] - x[a];
  const double py = y[n] - y[a];
  const double squared = ex * ex + ey * ey;
  ClosestPoint point;
  if (squared > 0) point.place = std::clamp((px * ex + py * ey) / squared, 0.0, 1.0);
  point.dx = px - point.place * ex;
  point.dy = py - point.place * ey;
  point.gap = std::sqrt(point.dx * point.dx + point.dy * point.dy);
  return point;
}

/// Elastic repulsion k_s (threshold - gap) of a node and the closest point of an edge; the edge's
/// ends share the reaction barycentrically. A gap of zero has no direction and no force.
inline void add_collision_forces(std::span<const CollisionPair> pairs, double stiffness,
                                 const Nodes& nodes, const Forces& forces) {
  for (const CollisionPair& pair : pairs) {
    const ClosestPoint point = closest_point(pair.node, pair.edge, nodes.x, nodes.y);
    if (point.gap >= pair.threshold || point.gap == 0) continue;
    const double size = stiffness * (pair.threshold - point.gap) / point.gap;
    const auto [a, b, i] = places<3>({pair.edge[0], pair.edge[1], pair.node});
    forces.x[i] += size * point.dx;
    forces.y[i] += size * point.dy;
    forces.x[a] -= (1 - point.place) * size * point.dx;
    forces.y[a] -= (1 - point.place) * size * point.dy;
    forces.x[b] -= point.place * size * point.dx;
    forces.y[b] -= point.place * size * point.dy;
  }
}

/// Sum of k_s (threshold - gap)^2 / 2 over the pairs in contact.
inline double collision_energy(std::span<const CollisionPair> pairs, double stiffness,
                               const Nodes& nodes) {
  double energy = 0;
  for (const CollisionPair& pair : pairs) {
    const double overlap =
        pair.threshold - closest_point(pair.node, pair.edge, nodes.x, nodes.y).gap;
    if (overlap > 0) energy += stiffness * overlap * overlap / 2;
  }
  return energy;
}

}  // namespace metamorph::kernels::reference
