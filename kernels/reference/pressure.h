#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "kernels/reference/views.h"

namespace metamorph::kernels::reference {

/// Triangles under pressure; both [triangles]. A triangle with S0 < min_area exerts none: it is a
/// sliver, and its pressure would be stiffer than any step resolves.
struct PressureCells {
  std::span<const Triangle> triangles;  ///< counter-clockwise
  std::span<const double> rest_area;    ///< S0
  double min_area = 0;
};

/// Signed area of a triangle, positive when counter-clockwise.
inline double signed_area(const Triangle& triangle, std::span<const double> x,
                          std::span<const double> y) {
  const auto [a, b, c] = places(triangle);
  return ((x[b] - x[a]) * (y[c] - y[a]) - (x[c] - x[a]) * (y[b] - y[a])) / 2;
}

/// Eq 1: on each edge c_p L (S0/S - 1) along its outward normal, half to each end. The halves that
/// a node receives from its two edges add up to P grad S with P = c_p (S0/S - 1), because grad S at
/// a node is half the opposite edge, turned by 90 degrees.
inline void add_pressure_forces(const PressureCells& cells, double pressure, const Nodes& nodes,
                                const Forces& forces) {
  for (std::size_t t = 0; t < cells.triangles.size(); ++t) {
    if (cells.rest_area[t] < cells.min_area) continue;
    const std::array<std::size_t, 3> corners = places(cells.triangles[t]);
    const double area = signed_area(cells.triangles[t], nodes.x, nodes.y);
    const double p = pressure * (cells.rest_area[t] / area - 1);
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::size_t i = corners[corner];
      const std::size_t next = corners[(corner + 1) % 3];
      const std::size_t last = corners[(corner + 2) % 3];
      forces.x[i] += p * (nodes.y[next] - nodes.y[last]) / 2;
      forces.y[i] += p * (nodes.x[last] - nodes.x[next]) / 2;
    }
  }
}

/// Sum of c_p (S - S0 - S0 ln(S/S0)), whose negative gradient is the pressure force. Infinite where
/// a triangle has no area left.
inline double pressure_energy(const PressureCells& cells, double pressure, const Nodes& nodes) {
  double energy = 0;
  for (std::size_t t = 0; t < cells.triangles.size(); ++t) {
    const double rest = cells.rest_area[t];
    if (rest < cells.min_area) continue;
    const double area = signed_area(cells.triangles[t], nodes.x, nodes.y);
    energy += pressure * (area - rest - rest * std::log(area / rest));
  }
  return energy;
}

}  // namespace metamorph::kernels::reference
