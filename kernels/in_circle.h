#pragma once

#include <cstdint>

#include "kernels/lanes.h"

namespace metamorph::kernels {

/// Quadrilaterals a, b, c, d by point numbers, one array per corner, each with room for a multiple
/// of Lanes<double>::width.
struct QuadrilateralView {
  const std::int32_t* a;
  const std::int32_t* b;
  const std::int32_t* c;
  const std::int32_t* d;
};

/// Writes to `doubtful` the numbers of those quadrilaterals whose d is not certainly outside the
/// circle through the counter-clockwise a, b, c, ascending, and returns how many they are. Certain
/// means beyond the error bound of the determinant in double (Shewchuk 1997). point: x, y of each;
/// doubtful: room for `count`.
inline int not_certainly_outside(const double (*point)[2], const QuadrilateralView& view, int count,
                                 std::int32_t* doubtful) {
  using Pack = Lanes<double>;
  constexpr double unit = 0x1p-53;
  const Pack factor((10 + 96 * unit) * unit);
  const auto fetch = [point](const std::int32_t* index, Pack& x, Pack& y) {
    for (int l = 0; l < Pack::width; ++l) {
      x.v[l] = point[index[l]][0];
      y.v[l] = point[index[l]][1];
    }
  };
  int found = 0;
  for (int first = 0; first < count; first += Pack::width) {
    Pack ax, ay, bx, by, cx, cy, dx, dy;
    fetch(view.a + first, ax, ay);
    fetch(view.b + first, bx, by);
    fetch(view.c + first, cx, cy);
    fetch(view.d + first, dx, dy);
    ax = ax - dx, ay = ay - dy, bx = bx - dx, by = by - dy, cx = cx - dx, cy = cy - dy;
    const Pack bxcy = bx * cy, cxby = cx * by, cxay = cx * ay, axcy = ax * cy;
    const Pack axby = ax * by, bxay = bx * ay;
    const Pack aa = ax * ax + ay * ay, bb = bx * bx + by * by, cc = cx * cx + cy * cy;
    const Pack determinant = aa * (bxcy - cxby) + bb * (cxay - axcy) + cc * (axby - bxay);
    const Pack permanent =
        (abs(bxcy) + abs(cxby)) * aa + (abs(cxay) + abs(axcy)) * bb + (abs(axby) + abs(bxay)) * cc;
    const std::uint32_t outside = bits(-determinant > factor * permanent);
    if (outside == (1u << Pack::width) - 1) continue;
    for (int l = 0; l < Pack::width && first + l < count; ++l) {
      if ((outside >> l & 1) == 0) doubtful[found++] = first + l;
    }
  }
  return found;
}

}  // namespace metamorph::kernels
