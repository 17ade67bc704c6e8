#pragma once

#include "kernels/lanes.h"

namespace metamorph::kernels {

/// Least upward velocity that keeps a node out of the ground y = 0 until the step's drift ends:
/// what is above may come down to it within the step, what is not may sink no further.
template <class T>
inline Lanes<T> least_rise(Lanes<T> y, Lanes<T> inverse_step) {
  return -(max(y, Lanes<T>(T(0))) * inverse_step);
}

/// Coulomb friction as an impulse on the sliding velocity after the kick: at most mu times the
/// normal impulse of the step (over the mass), and never reversing the direction of sliding.
template <class T>
inline Lanes<T> after_friction(Lanes<T> v, Lanes<T> largest_change) {
  const Lanes<T> zero(T(0));
  return sign_flipped(max(abs(v) - largest_change, zero), v);
}
template <class T>
inline T after_friction(T v, T largest_change) {
  return std::copysign(std::max(std::abs(v) - largest_change, T(0)), v);
}

}  // namespace metamorph::kernels
