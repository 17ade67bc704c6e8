#pragma once

#include "kernels/lanes.h"

namespace metamorph::kernels {

/// How rest lengths swing, eq 3.
enum class Actuation : unsigned {
  none,          ///< settling: they do not, and every node has drag of its own
  one_period,    ///< all oscillators share the main period: a fraction of the arithmetic
  mixed_periods  ///< some have another (off_period); what does not gets the same bits
};

/// Which terms a step is composed of. A term that is off costs nothing.
struct Terms {
  bool pressure = true;
  bool drag = false;    ///< of outline edges, eq 4 and 5
  bool ground = false;  ///< gravity, solid ground, friction
  bool extra = false;   ///< forces from outside the step
  Actuation actuation = Actuation::one_period;
};

/// Every composition of terms has a number, to tabulate them.
inline constexpr unsigned compositions = 48;
constexpr Terms terms_from(unsigned number) {
  return {.pressure = (number & 1u) != 0,
          .drag = (number & 2u) != 0,
          .ground = (number & 4u) != 0,
          .extra = (number & 8u) != 0,
          .actuation = static_cast<Actuation>(number >> 4)};
}
constexpr unsigned number_of(const Terms& terms) {
  return (terms.pressure ? 1u : 0u) | (terms.drag ? 2u : 0u) | (terms.ground ? 4u : 0u) |
         (terms.extra ? 8u : 0u) | static_cast<unsigned>(terms.actuation) << 4;
}

/// Coefficients of a step, one value for all lanes.
template <class T>
struct StepCoefficients {
  T step = 0;         ///< h
  T extrapolate = 0;  ///< h/2: drift-kick-drift; 0: symplectic Euler
  T stiffness = 1, damping = 0, pressure = 0;
  T amplitude = 0;     ///< A r(t), ramp included; set per step
  T swing_sine = 0;    ///< A r(t) sin(2 pi t/T), T the body's main period
  T swing_cosine = 0;  ///< A r(t) cos(2 pi t/T)
  T drag_normal = 0, drag_tangential = 0;
  T gravity_x = 0, gravity_y = 0;
  T friction = 0;
  T settle_drag = 0;
};

/// Extremes seen by steps since the last reset, each lane for itself.
template <class T>
struct StepExtremes {
  Lanes<T> largest_ratio{T(0)};   ///< of S0/S
  Lanes<T> smallest_ratio{T(0)};  ///< negative once a triangle was inside out
  Lanes<T> largest_speed2{T(0)};  ///< squared speed
  Lanes<T> not_finite{T(0)};      ///< not a number once a velocity was infinite or none
};

}  // namespace metamorph::kernels
