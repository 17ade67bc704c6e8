#pragma once

#include <algorithm>
#include <cmath>

#include "core/reference/system.h"
#include "tests/bodies.h"
#include "tests/physics.h"

namespace metamorph::tests {

/// Energy of an undamped body along its way, as deviations from the start over the elastic energy
/// at the start.
struct EnergyRecord {
  double first_half = 0, second_half = 0;  ///< largest deviation in each half of the time
  double last = 0;                         ///< deviation at the end
};

inline EnergyRecord energy_record(core::ReferenceMethod method, double h, double duration) {
  core::ReferenceSystem system(blob_body(20, 3), vacuum_scene());
  disturb(system, 0.05, 0, 2);
  const double start = system.potential_energy(0);
  EnergyRecord record;
  const long steps = std::lround(duration / h);
  for (long n = 1; n <= steps; ++n) {
    system.step(method, 0, h);
    record.last = (system.potential_energy(0) + system.kinetic_energy()) / start - 1;
    double& largest = 2 * n <= steps ? record.first_half : record.second_half;
    largest = std::max(largest, std::fabs(record.last));
  }
  return record;
}

/// By how much, of itself, the deviation is larger in the second half than in the first; at least
/// 0.
inline double growth(const EnergyRecord& record) {
  return std::max(record.second_half / record.first_half - 1, 0.0);
}

/// What drift-kick-drift conserves of an oscillation of frequency w is (1 - (w h)^2/4) K + U, so
/// that K ends (w h)^2/4 above the U of the start; w_max^2 = 5.7 k + 4.3 c_p at rest (NUMERICS
/// section 2).
inline double leapfrog_energy_error(double h) { return 10.0 * h * h / 4; }

}  // namespace metamorph::tests
