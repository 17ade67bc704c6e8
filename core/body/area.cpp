#include "core/body/area.h"

#include <cstddef>

namespace metamorph::core {
namespace {

/// Corners of a triangle, seen from a point.
struct Corners {
  std::array<double, 3> x, y;
  double area;
};

Corners corners(const Body& body, const std::array<Index, 3>& triangle,
                const std::array<double, 2>& from) {
  Corners c{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto node = static_cast<std::size_t>(triangle[i]);
    c.x[i] = body.x[node] - from[0];
    c.y[i] = body.y[node] - from[1];
  }
  c.area = 0.5 * ((c.x[1] - c.x[0]) * (c.y[2] - c.y[0]) - (c.x[2] - c.x[0]) * (c.y[1] - c.y[0]));
  return c;
}

}  // namespace

Area area_of(const Body& body) {
  const std::array<double, 2> origin = {body.x[0], body.y[0]};  // keeps rounding small
  Area area;
  double sum_x = 0, sum_y = 0;
  for (const auto& triangle : body.triangles) {
    const Corners c = corners(body, triangle, origin);
    area.size += c.area;
    sum_x += c.area * (c.x[0] + c.x[1] + c.x[2]);
    sum_y += c.area * (c.y[0] + c.y[1] + c.y[2]);
  }
  double count = 3 * area.size;
  if (!(area.size > 0)) {
    count = static_cast<double>(body.x.size());
    sum_x = sum_y = 0;
    for (std::size_t i = 0; i < body.x.size(); ++i) {
      sum_x += body.x[i] - origin[0];
      sum_y += body.y[i] - origin[1];
    }
  }
  area.centroid = {origin[0] + sum_x / count, origin[1] + sum_y / count};
  return area;
}

// The integral of u v over a triangle, both linear, is area/12 (sum of u_i v_i + sum of u_i times
// sum of v_i) over its corners.
SecondMoments second_moments(const Body& body, const std::array<double, 2>& centroid) {
  SecondMoments moments;
  for (const auto& triangle : body.triangles) {
    const auto& [x, y, area] = corners(body, triangle, centroid);
    const double sum_x = x[0] + x[1] + x[2], sum_y = y[0] + y[1] + y[2];
    moments.xx += area / 12 * (x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + sum_x * sum_x);
    moments.xy += area / 12 * (x[0] * y[0] + x[1] * y[1] + x[2] * y[2] + sum_x * sum_y);
    moments.yy += area / 12 * (y[0] * y[0] + y[1] * y[1] + y[2] * y[2] + sum_y * sum_y);
  }
  return moments;
}

}  // namespace metamorph::core
