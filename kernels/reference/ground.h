#pragma once

#include <algorithm>
#include <cmath>

namespace metamorph::kernels::reference {

/// Coulomb friction as an impulse: the sliding velocity v loses at most `change` (mu times the
/// normal impulse, over the mass) and never turns round. Not-a-number passes through.
inline double after_friction(double v, double change) {
  return std::copysign(std::max(std::fabs(v) - change, 0.0), v);
}

/// A node at height y meets the solid ground y = 0 before a drift of h: it may come down to the
/// ground within the drift, and sinks no further where it is not above; the impulse that this takes
/// bounds friction. Velocities are changed; returns whether they were.
inline bool meet_ground(double y, double h, double friction, double& vx, double& vy) {
  const double least = -std::max(y, 0.0) / h;
  if (vy >= least) return false;
  vx = after_friction(vx, friction * (least - vy));
  vy = least;
  return true;
}

}  // namespace metamorph::kernels::reference
