#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "kernels/reference/views.h"

namespace metamorph::kernels::reference {

/// Ground at y = 0: per node k_n * depth - c_n * v_y while y < 0, never pulling. normal[i] receives
/// the force (0 above the ground), which is also added to the sums.
inline void add_ground_forces(double stiffness, double damping, const Nodes& nodes,
                              std::span<double> normal, const Forces& forces) {
  for (std::size_t i = 0; i < normal.size(); ++i) {
    normal[i] = 0;
    if (nodes.y[i] < 0) normal[i] = std::max(-stiffness * nodes.y[i] - damping * nodes.vy[i], 0.0);
    forces.y[i] += normal[i];
  }
}

/// Elastic energy of the nodes that are below the ground.
inline double ground_energy(double stiffness, const Nodes& nodes) {
  double energy = 0;
  for (const double y : nodes.y)
    if (y < 0) energy += stiffness * y * y / 2;
  return energy;
}

/// Coulomb friction as an impulse: the sliding velocity v loses at most `change` (mu times the
/// normal impulse, over the mass) and never turns round. Not-a-number passes through.
inline double after_friction(double v, double change) {
  return std::copysign(std::max(std::fabs(v) - change, 0.0), v);
}

}  // namespace metamorph::kernels::reference
