#pragma once

#include <array>

#include "metamorph/body.h"

namespace metamorph::core {

/// What the triangles of a body cover.
struct Area {
  double size = 0;                   ///< d^2
  std::array<double, 2> centroid{};  ///< d; of a body without area the mean of its nodes
};
Area area_of(const Body& body);

/// Second moments of that area about its centroid, d^4.
struct SecondMoments {
  double xx = 0, xy = 0, yy = 0;
};
SecondMoments second_moments(const Body& body, const std::array<double, 2>& centroid);

}  // namespace metamorph::core
