#pragma once

#include "kernels/lanes.h"

namespace metamorph::kernels {

template <class T>
struct GroundCoefficients {
  Lanes<T> stiffness;  ///< k_n
  Lanes<T> damping;    ///< c_n
  Lanes<T> friction;   ///< mu
};

/// Normal force of the ground y = 0 on a node: k_n depth - c_n v_y while below, never pulling.
template <class T>
inline Lanes<T> ground_normal(Lanes<T> y, Lanes<T> vy, const GroundCoefficients<T>& ground) {
  const Lanes<T> zero(T(0));
  const Lanes<T> push = fma(-ground.damping, vy, -(ground.stiffness * y));
  return select(y < zero, max(push, zero), zero);
}

/// Coulomb friction as an impulse on the sliding velocity after the kick: at most mu times the
/// normal impulse of the step, and never reversing the direction of sliding.
template <class T>
inline Lanes<T> after_friction(Lanes<T> v, Lanes<T> largest_change) {
  const Lanes<T> zero(T(0));
  return sign_flipped(max(abs(v) - largest_change, zero), v);
}

}  // namespace metamorph::kernels
