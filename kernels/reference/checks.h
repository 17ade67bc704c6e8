#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "kernels/reference/pressure.h"
#include "kernels/reference/views.h"

namespace metamorph::kernels::reference {

enum class Fault { none, inverted, collapsed, speed, non_finite };

/// What a state may not exceed (NUMERICS section 8). Inversion and non-finite values are
/// absorbing, so a look every few steps misses neither.
struct Limits {
  double area_ratio = 0.05;  ///< S/S0 below this: collapsed
  double travel = 0.8;       ///< |v| h above this: speed; d
  double speed = 4.0;        ///< |v| above this: speed; d per time unit
};

struct Health {
  Fault fault = Fault::none;
  int index = -1;    ///< triangle of inverted and collapsed, node of speed and non_finite
  double value = 0;  ///< area ratio, speed, or the value that is not finite
  double min_area_ratio = std::numeric_limits<double>::infinity();
  double max_speed = 0;
};

/// Looks at one state. The worst triangle or node is named; of several faults the first of
/// non-finite, inverted, collapsed, speed. Triangles too small for pressure do not count.
inline Health examine(const PressureCells& cells, const Nodes& nodes, double h,
                      const Limits& limits) {
  Health health;
  int fastest = -1;
  for (std::size_t i = 0; i < nodes.x.size(); ++i) {
    for (const double value : {nodes.x[i], nodes.y[i], nodes.vx[i], nodes.vy[i]})
      if (!std::isfinite(value)) {
        health.fault = Fault::non_finite;
        health.index = static_cast<int>(i);
        health.value = value;
        return health;
      }
    const double speed = std::sqrt(nodes.vx[i] * nodes.vx[i] + nodes.vy[i] * nodes.vy[i]);
    if (fastest < 0 || speed > health.max_speed) {
      health.max_speed = speed;
      fastest = static_cast<int>(i);
    }
  }
  int smallest = -1;
  for (std::size_t t = 0; t < cells.triangles.size(); ++t) {
    if (cells.rest_area[t] < cells.min_area) continue;
    const double ratio = signed_area(cells.triangles[t], nodes.x, nodes.y) / cells.rest_area[t];
    if (ratio < health.min_area_ratio) {
      health.min_area_ratio = ratio;
      smallest = static_cast<int>(t);
    }
  }
  if (health.min_area_ratio < limits.area_ratio) {
    health.fault = health.min_area_ratio <= 0 ? Fault::inverted : Fault::collapsed;
    health.index = smallest;
    health.value = health.min_area_ratio;
  } else if (health.max_speed > limits.speed || health.max_speed * h > limits.travel) {
    health.fault = Fault::speed;
    health.index = fastest;
    health.value = health.max_speed;
  }
  return health;
}

}  // namespace metamorph::kernels::reference
