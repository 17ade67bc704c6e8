#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

#include "kernels/reference/views.h"

namespace metamorph::kernels::reference {

/// The oscillators of eq 3; all [nodes]. Periods in time units, phases in radians.
struct Oscillators {
  std::span<const double> period, phase;
};

/// Share of the full amplitude at time t: from 0 at t = 0 to 1 at `ramp_time`, then 1.
inline double ramp(double t, double ramp_time) { return t < ramp_time ? t / ramp_time : 1.0; }

/// sin(2 pi t/T + phi). Whole periods are removed before the sine, so that the signal does not
/// coarsen as t grows.
inline double oscillation(double t, double period, double phase) {
  const double cycles = t / period;
  return std::sin(2 * std::numbers::pi * (cycles - std::floor(cycles)) + phase);
}

/// Eq 3: length[s] = L0 [1 + A r(t) (sin(2 pi t/T1 + phi1) + sin(2 pi t/T2 + phi2))], where 1 and 2
/// are the ends of spring s. `amplitude` is A r(t).
inline void actuate(std::span<const Edge> springs, std::span<const double> rest_length,
                    const Oscillators& oscillators, double amplitude, double t,
                    std::span<double> length) {
  for (std::size_t s = 0; s < springs.size(); ++s) {
    const auto [i, j] = places(springs[s]);
    const double both = oscillation(t, oscillators.period[i], oscillators.phase[i]) +
                        oscillation(t, oscillators.period[j], oscillators.phase[j]);
    length[s] = rest_length[s] * (1 + amplitude * both);
  }
}

}  // namespace metamorph::kernels::reference
