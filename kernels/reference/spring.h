#pragma once

#include <cmath>
#include <cstddef>
#include <span>

#include "kernels/reference/views.h"

namespace metamorph::kernels::reference {

/// Eq 2 on every spring: k (l - L) + c dl/dt, pulling the ends together. The rate is that of the
/// current length l alone; L is the actuated rest length, whose own rate is left out (MODEL
/// section 4). A spring of length zero has no direction and exerts no force.
inline void add_spring_forces(std::span<const Edge> springs, std::span<const double> length,
                              double stiffness, double damping, const Nodes& nodes,
                              const Forces& forces) {
  for (std::size_t s = 0; s < springs.size(); ++s) {
    const auto [i, j] = places(springs[s]);
    const double dx = nodes.x[j] - nodes.x[i];
    const double dy = nodes.y[j] - nodes.y[i];
    const double distance = std::sqrt(dx * dx + dy * dy);
    if (distance == 0) continue;
    const double ux = dx / distance;
    const double uy = dy / distance;
    const double rate = (nodes.vx[j] - nodes.vx[i]) * ux + (nodes.vy[j] - nodes.vy[i]) * uy;
    const double tension = stiffness * (distance - length[s]) + damping * rate;
    forces.x[i] += tension * ux;
    forces.y[i] += tension * uy;
    forces.x[j] -= tension * ux;
    forces.y[j] -= tension * uy;
  }
}

/// Sum of k (l - L)^2 / 2: what the undamped springs are the gradient of.
inline double spring_energy(std::span<const Edge> springs, std::span<const double> length,
                            double stiffness, const Nodes& nodes) {
  double energy = 0;
  for (std::size_t s = 0; s < springs.size(); ++s) {
    const auto [i, j] = places(springs[s]);
    const double dx = nodes.x[j] - nodes.x[i];
    const double dy = nodes.y[j] - nodes.y[i];
    const double stretch = std::sqrt(dx * dx + dy * dy) - length[s];
    energy += stiffness * stretch * stretch / 2;
  }
  return energy;
}

}  // namespace metamorph::kernels::reference
