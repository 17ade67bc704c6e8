#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "kernels/reference/views.h"

namespace metamorph::kernels::reference {

/// Every outline node against every outline edge.
struct CollisionPairs {
  std::span<const int> nodes;         ///< outline nodes
  std::span<const Edge> edges;        ///< outline edges
  std::span<const double> threshold;  ///< [nodes x edges] gap below which they repel; 0: never
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

inline bool has_end(const Edge& edge, int node) { return edge[0] == node || edge[1] == node; }

/// True for the edges that a walk along the outline from `node` takes first or second, whichever
/// way it turns: the edges at the node, and all that share an end with one of these.
inline bool within_two_hops(int node, const Edge& edge, std::span<const Edge> outline) {
  if (has_end(edge, node)) return true;
  for (const Edge& first : outline) {
    if (!has_end(first, node)) continue;
    if (has_end(edge, first[0] == node ? first[1] : first[0])) return true;
  }
  return false;
}

/// Thresholds of the pairs of a body at rest: `gap`, or the distance at rest where that is smaller;
/// 0 within two outline hops.
inline void set_collision_thresholds(std::span<const int> nodes, std::span<const Edge> edges,
                                     double gap, std::span<const double> x,
                                     std::span<const double> y, std::span<double> threshold) {
  for (std::size_t n = 0; n < nodes.size(); ++n)
    for (std::size_t e = 0; e < edges.size(); ++e)
      threshold[n * edges.size() + e] =
          within_two_hops(nodes[n], edges[e], edges)
              ? 0.0
              : std::min(gap, closest_point(nodes[n], edges[e], x, y).gap);
}

/// Elastic repulsion k_s (threshold - gap) of a node and the closest point of an edge; the edge's
/// ends share the reaction barycentrically. A gap of zero has no direction and no force.
inline void add_collision_forces(const CollisionPairs& pairs, double stiffness, const Nodes& nodes,
                                 const Forces& forces) {
  for (std::size_t n = 0; n < pairs.nodes.size(); ++n) {
    const int node = pairs.nodes[n];
    for (std::size_t e = 0; e < pairs.edges.size(); ++e) {
      const double threshold = pairs.threshold[n * pairs.edges.size() + e];
      if (threshold == 0) continue;
      const ClosestPoint point = closest_point(node, pairs.edges[e], nodes.x, nodes.y);
      if (point.gap >= threshold || point.gap == 0) continue;
      const double size = stiffness * (threshold - point.gap) / point.gap;
      const auto [a, b, i] = places<3>({pairs.edges[e][0], pairs.edges[e][1], node});
      forces.x[i] += size * point.dx;
      forces.y[i] += size * point.dy;
      forces.x[a] -= (1 - point.place) * size * point.dx;
      forces.y[a] -= (1 - point.place) * size * point.dy;
      forces.x[b] -= point.place * size * point.dx;
      forces.y[b] -= point.place * size * point.dy;
    }
  }
}

/// Sum of k_s (threshold - gap)^2 / 2 over the pairs in contact.
inline double collision_energy(const CollisionPairs& pairs, double stiffness, const Nodes& nodes) {
  double energy = 0;
  for (std::size_t n = 0; n < pairs.nodes.size(); ++n)
    for (std::size_t e = 0; e < pairs.edges.size(); ++e) {
      const double threshold = pairs.threshold[n * pairs.edges.size() + e];
      if (threshold == 0) continue;
      const double overlap =
          threshold - closest_point(pairs.nodes[n], pairs.edges[e], nodes.x, nodes.y).gap;
      if (overlap > 0) energy += stiffness * overlap * overlap / 2;
    }
  return energy;
}

}  // namespace metamorph::kernels::reference
