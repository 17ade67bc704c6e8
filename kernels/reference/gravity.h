#pragma once

#include <cstddef>
#include <span>

#include "kernels/reference/views.h"

namespace metamorph::kernels::reference {

/// Weight on a ground that rises towards +x by the angle alpha, in coordinates along and across it:
/// (x, y) = g (-sin alpha, -cos alpha).
struct Gravity {
  double x = 0, y = 0;
};

inline void add_weight(const Gravity& gravity, double mass, const Forces& forces) {
  for (std::size_t i = 0; i < forces.x.size(); ++i) {
    forces.x[i] += mass * gravity.x;
    forces.y[i] += mass * gravity.y;
  }
}

/// Potential energy of the weights; zero at the origin.
inline double weight_energy(const Gravity& gravity, double mass, const Nodes& nodes) {
  double energy = 0;
  for (std::size_t i = 0; i < nodes.x.size(); ++i)
    energy -= mass * (gravity.x * nodes.x[i] + gravity.y * nodes.y[i]);
  return energy;
}

}  // namespace metamorph::kernels::reference
