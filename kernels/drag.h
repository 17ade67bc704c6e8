#pragma once

#include "kernels/lanes.h"

namespace metamorph::kernels {

template <class T>
struct DragCoefficients {
  Lanes<T> normal;      ///< d_N
  Lanes<T> tangential;  ///< d_T
};

/// Adds one end's half of the drag of an outline edge (eq 4, 5), seen from that end.
///
/// d = (dx, dy) leads to the other end, L = |d|, (vx, vy) is the velocity of the edge's centre.
/// With t = v . d = L v_T and n = v . d' = L v_N, where d' is d turned by 90 degrees,
///     F_T = -d_T L |v_T| v_T d / L = -d_T |t| t / L^2 d,   F_N = -d_N |n| n / L^2 d'.
/// Seen from the other end d, t and n change sign and the force stays as it is, bit for bit.
template <class T>
inline void add_edge_drag(Lanes<T> dx, Lanes<T> dy, Lanes<T> vx, Lanes<T> vy,
                          const DragCoefficients<T>& drag, Lanes<T> present, Lanes<T>& fx,
                          Lanes<T>& fy) {
  const Lanes<T> tiny(T(1e-12));
  const Lanes<T> length2 = max(fma(dx, dx, dy * dy), tiny);
  const Lanes<T> half = Lanes<T>(T(-0.5)) * present / length2;
  const Lanes<T> t = fma(vx, dx, vy * dy);
  const Lanes<T> n = fma(vy, dx, -(vx * dy));
  const Lanes<T> along = drag.tangential * half * abs(t) * t;
  const Lanes<T> across = drag.normal * half * abs(n) * n;
  fx += fma(along, dx, -(across * dy));
  fy += fma(along, dy, across * dx);
}

}  // namespace metamorph::kernels
