#pragma once

#include "kernels/lanes.h"

namespace metamorph::kernels {

/// Half the pressure of one triangle: multiply by the opposite edge turned by 90 degrees to get the
/// force on a corner.
///
/// eq 1 puts c_p L (S0/S - 1) on each edge, half to each end, so that corner i receives
/// P grad_i S with P = c_p (S0/S - 1), and grad_i S is half the opposite edge, turned:
/// an exact gradient of U = c_p (S - S0 - S0 ln(S/S0)).
/// `ratio` is S0/S.
template <class T>
inline Lanes<T> half_pressure(Lanes<T> ratio, Lanes<T> half_coefficient) {
  return fma(half_coefficient, ratio, -half_coefficient);
}

}  // namespace metamorph::kernels
