#pragma once

#include <cmath>

namespace metamorph::core {

/// Signs of the two determinants behind a Delaunay triangulation, always right: computed in double
/// with an error bound (Shewchuk, Adaptive precision floating-point arithmetic and fast robust
/// geometric predicates, 1997), and exactly where the bound does not decide. The bounds hold as
/// long as nothing under- or overflows, which no coordinates that are floats can do.

struct Point {
  double x, y;
};

/// Exact, slow.
int exact_orientation(Point a, Point b, Point c);
/// Exact, slow; cocircular points are resolved as triangulate() does, so never 0.
int exact_in_circle(Point a, Point b, Point c, Point d);

/// 1 if a, b, c turn left (counter-clockwise), -1 if right, 0 if they lie on a straight line.
inline int orientation(Point a, Point b, Point c) {
  constexpr double unit = 0x1p-53;
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  const double determinant = left - right;
  const double bound = (3 + 16 * unit) * unit * (std::fabs(left) + std::fabs(right));
  if (determinant > bound) return 1;
  if (-determinant > bound) return -1;
  return exact_orientation(a, b, c);
}

/// 1 if d lies inside the circle through the counter-clockwise a, b, c, -1 if outside.
inline int in_circle(Point a, Point b, Point c, Point d) {
  constexpr double unit = 0x1p-53;
  const double ax = a.x - d.x, ay = a.y - d.y;
  const double bx = b.x - d.x, by = b.y - d.y;
  const double cx = c.x - d.x, cy = c.y - d.y;
  const double bxcy = bx * cy, cxby = cx * by;
  const double cxay = cx * ay, axcy = ax * cy;
  const double axby = ax * by, bxay = bx * ay;
  const double aa = ax * ax + ay * ay, bb = bx * bx + by * by, cc = cx * cx + cy * cy;
  const double determinant = aa * (bxcy - cxby) + bb * (cxay - axcy) + cc * (axby - bxay);
  const double permanent = (std::fabs(bxcy) + std::fabs(cxby)) * aa +
                           (std::fabs(cxay) + std::fabs(axcy)) * bb +
                           (std::fabs(axby) + std::fabs(bxay)) * cc;
  const double bound = (10 + 96 * unit) * unit * permanent;
  if (determinant > bound) return 1;
  if (-determinant > bound) return -1;
  return exact_in_circle(a, b, c, d);
}

}  // namespace metamorph::core
