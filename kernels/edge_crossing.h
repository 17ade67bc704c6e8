#pragma once

#include <cstdint>
#include <limits>

#include "kernels/lanes.h"

namespace metamorph::kernels {

/// Edges of an outline, for a look at whether any two cross. All arrays are filled up to whole lane
/// groups; what fills them is never looked at.
template <class T>
struct EdgeLook {
  int edges;
  const T* first;   ///< number of the first end: a node's lane, as a number that compares
  const T* second;  ///< and of the second
  const T *ax, *ay, *bx, *by;  ///< where they are
};

/// True if two edges without a common end may cross or touch: true whenever they do, and wrongly so
/// only where it is closer than rounding can tell.
template <class T>
inline bool any_may_cross(const EdgeLook<T>& look) {
  using Pack = Lanes<T>;
  const Pack zero(T(0)), rounding(8 * std::numeric_limits<T>::epsilon());
  // Both ends of one edge on one side of the line through the other, beyond rounding.
  const auto apart = [&](Pack ex, Pack ey, Pack px, Pack py, Pack qx, Pack qy) {
    const Pack p1 = ex * py, p2 = ey * px, q1 = ex * qy, q2 = ey * qx;
    const Pack p = p1 - p2, q = q1 - q2;
    const Pack p_error = rounding * (abs(p1) + abs(p2)), q_error = rounding * (abs(q1) + abs(q2));
    return (min(p - p_error, q - q_error) > zero) | (max(p + p_error, q + q_error) < zero);
  };
  for (int i = 1; i < look.edges; ++i) {
    const Pack first(look.first[i]), second(look.second[i]);
    const Pack ax(look.ax[i]), ay(look.ay[i]), bx(look.bx[i]), by(look.by[i]);
    for (int base = 0; base < i; base += Pack::width) {
      const Pack cx = Pack::load(look.ax + base), cy = Pack::load(look.ay + base);
      const Pack dx = Pack::load(look.bx + base), dy = Pack::load(look.by + base);
      const auto far = apart(bx - ax, by - ay, cx - ax, cy - ay, dx - ax, dy - ay) |
                       apart(dx - cx, dy - cy, ax - cx, ay - cy, bx - cx, by - cy);
      const int there = i - base < Pack::width ? i - base : Pack::width;
      const std::uint32_t real = (1u << there) - 1;
      const std::uint32_t near = ~bits(far) & real;
      if (near == 0) continue;
      const Pack c = Pack::load(look.first + base), d = Pack::load(look.second + base);
      const Pack joined = abs((c - first) * (c - second) * (d - first) * (d - second));
      if ((near & bits(joined > zero)) != 0) return true;
    }
  }
  return false;
}

}  // namespace metamorph::kernels
