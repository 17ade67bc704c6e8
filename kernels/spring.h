#pragma once

#include "kernels/lanes.h"

namespace metamorph::kernels {

/// Force of one spring on the node at its start, divided by its length: multiply by (dx, dy).
///
/// eq 2 with x = length - rest_length and damping along the spring on the relative velocity (the
/// rest length's own rate is left out, MODEL section 4):
///     F = [k (l - L) + c (dv . d) / l] d / l = [k (l - L) l + c (dv . d)] d / l^2,
/// in which the division need not wait for the root. `present` is 1, or 0 for a slot that holds no
/// spring.
template <class T>
inline Lanes<T> spring_tension(Lanes<T> dx, Lanes<T> dy, Lanes<T> dvx, Lanes<T> dvy,
                               Lanes<T> length, Lanes<T> inverse_length2, Lanes<T> rest_length,
                               Lanes<T> stiffness, Lanes<T> damping, Lanes<T> present) {
  const Lanes<T> approach = fma(dvx, dx, dvy * dy);
  const Lanes<T> stretch = stiffness * length * (length - rest_length);
  return fma(damping, approach, stretch) * (inverse_length2 * present);
}

}  // namespace metamorph::kernels
