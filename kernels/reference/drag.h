#pragma once

#include <cmath>
#include <cstddef>
#include <span>

#include "kernels/reference/views.h"

namespace metamorph::kernels::reference {

/// Eq 4 and 5 on every outline edge, from the velocity of its centre and its current length L:
/// F_T = -d_T L |v_T| v_T along the edge, F_N = -d_N L |v_N| v_N across it, half to each end.
/// The direction of the edge does not matter. An edge of length zero exerts no force.
inline void add_drag_forces(std::span<const Edge> outline, double normal, double tangential,
                            const Nodes& nodes, const Forces& forces) {
  for (const Edge& edge : outline) {
    const auto [i, j] = places(edge);
    const double dx = nodes.x[j] - nodes.x[i];
    const double dy = nodes.y[j] - nodes.y[i];
    const double length = std::sqrt(dx * dx + dy * dy);
    if (length == 0) continue;
    const double tx = dx / length;
    const double ty = dy / length;
    const double vx = (nodes.vx[i] + nodes.vx[j]) / 2;
    const double vy = (nodes.vy[i] + nodes.vy[j]) / 2;
    const double along = vx * tx + vy * ty;
    const double across = vy * tx - vx * ty;  // along (-ty, tx)
    const double force_t = -tangential * length * std::fabs(along) * along;
    const double force_n = -normal * length * std::fabs(across) * across;
    const double fx = (force_t * tx - force_n * ty) / 2;
    const double fy = (force_t * ty + force_n * tx) / 2;
    forces.x[i] += fx;
    forces.y[i] += fy;
    forces.x[j] += fx;
    forces.y[j] += fy;
  }
}

/// -coefficient * v on every node: the extra drag while a body settles.
inline void add_node_drag(double coefficient, const Nodes& nodes, const Forces& forces) {
  for (std::size_t i = 0; i < forces.x.size(); ++i) {
    forces.x[i] -= coefficient * nodes.vx[i];
    forces.y[i] -= coefficient * nodes.vy[i];
  }
}

}  // namespace metamorph::kernels::reference
