#include "kernels/in_circle.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace metamorph::kernels {
namespace {

/// Quadrilaterals of their own four points each: three on the unit circle about (x, 0), and a
/// fourth on it at a distance from its centre.
struct Quadrilaterals {
  std::vector<std::array<double, 2>> points;
  std::array<std::vector<std::int32_t>, 4> corner;
  int count = 0;

  void add(double x, double distance) {
    for (const double angle : {0.1, 1.3, 4.0}) {
      points.push_back({x + std::cos(angle), std::sin(angle)});
    }
    points.push_back({x + distance * std::cos(5.0), distance * std::sin(5.0)});
    for (std::size_t k = 0; k < 4; ++k) {
      corner[k].resize(static_cast<std::size_t>(count));
      corner[k].push_back(4 * count + static_cast<std::int32_t>(k));
    }
    ++count;
  }

  std::vector<std::int32_t> doubtful() {
    const auto padded = static_cast<std::size_t>(count + Lanes<double>::width);
    for (auto& numbers : corner) numbers.resize(padded);
    std::vector<std::int32_t> result(padded);
    const QuadrilateralView view = {corner[0].data(), corner[1].data(), corner[2].data(),
                                    corner[3].data()};
    const int found = not_certainly_outside(reinterpret_cast<const double(*)[2]>(points.data()),
                                            view, count, result.data());
    result.resize(static_cast<std::size_t>(found));
    return result;
  }
};

TEST(InCircle, SortsOutWhatIsCertainlyOutside) {
  for (int count = 0; count < 40; ++count) {
    Quadrilaterals all;
    std::vector<std::int32_t> inside;
    for (int n = 0; n < count; ++n) {
      const bool is_inside = n * n % 3 == 1;
      all.add(n, is_inside ? 0.99 : 1.01);
      if (is_inside) inside.push_back(n);
    }
    EXPECT_EQ(all.doubtful(), inside);
  }
}

// On the circle the determinant is a rounding error, which the bound must cover.
TEST(InCircle, WhatLiesOnTheCircleIsDoubtful) {
  Quadrilaterals all;
  for (int n = 0; n < 100; ++n) all.add(0.37 * n, 1);
  EXPECT_EQ(all.doubtful().size(), 100u);
}

}  // namespace
}  // namespace metamorph::kernels
