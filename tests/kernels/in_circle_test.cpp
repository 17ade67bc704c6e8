#include "kernels/in_circle.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace metamorph::kernels {
namespace {

/// Edges a-b of their own four points each: a, b and c on the unit circle about (x, 0), d on the
/// same ray from its centre as before, on the other side of the edge, at a distance.
struct Quadrilaterals {
  std::vector<std::array<double, 2>> points;
  std::array<std::vector<std::int32_t>, 4> corner;
  std::vector<double> square;
  int count = 0;

  void add(double x, double distance) {
    for (const double angle : {4.0, 5.9, 1.3}) {
      points.push_back({x + std::cos(angle), std::sin(angle)});
    }
    points.push_back({x + distance * std::cos(5.0), distance * std::sin(5.0)});
    for (std::size_t k = 0; k < 4; ++k) {
      corner[k].resize(static_cast<std::size_t>(count));
      corner[k].push_back(2 * (4 * count + static_cast<std::int32_t>(k)));
    }
    ++count;
  }

  std::vector<std::int32_t> doubtful() {
    const auto padded = static_cast<std::size_t>(count + Lanes<double>::width);
    for (auto& places : corner) places.resize(padded);
    std::vector<std::int32_t> result(padded);
    square.resize(padded);
    if (points.empty()) points.push_back({0, 0});
    struct alignas(16) Record {
      double x, y;
    };
    std::vector<Record> records;
    for (const auto& [x, y] : points) records.push_back({x, y});
    const QuadrilateralView view = {corner[0].data(), corner[1].data(), corner[2].data(),
                                    corner[3].data()};
    const int found = certify_edges(&records.front().x, view, count, result.data(), square.data());
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

TEST(InCircle, AFaceThatIsNotCounterClockwiseIsDoubtful) {
  for (const std::size_t corner : {2u, 3u}) {
    Quadrilaterals all;
    for (int n = 0; n < 20; ++n) all.add(n, 1.01);
    // Across the edge, or onto the line through it: exactly, as n and the two ends are.
    for (int n = 0; n < 20; n += 2) {
      const auto first = static_cast<std::size_t>(4 * n);
      all.points[first] = {n - 1.0, 0};
      all.points[first + 1] = {n + 1.0, 0};
      all.points[first + 2] = {n + 0.0, 1};
      all.points[first + 3] = {n + 0.0, -2};
      all.points[first + corner] = {n + 0.0, n % 4 == 0 ? 0.0 : corner == 2 ? -0.1 : 0.1};
    }
    std::vector<std::int32_t> even;
    for (int n = 0; n < 20; n += 2) even.push_back(n);
    EXPECT_EQ(all.doubtful(), even);
  }
}

TEST(InCircle, AsksNothingWhereThereIsNoFourthCorner) {
  Quadrilaterals all;
  for (int n = 0; n < 20; ++n) all.add(n, 0.5);
  for (int n = 0; n < 20; n += 3) {
    all.points[static_cast<std::size_t>(4 * n + 3)].fill(std::nan(""));
  }
  std::vector<std::int32_t> others;
  for (int n = 0; n < 20; ++n) {
    if (n % 3 != 0) others.push_back(n);
  }
  EXPECT_EQ(all.doubtful(), others);
}

TEST(InCircle, TellsTheSquareOfEveryEdge) {
  Quadrilaterals all;
  for (int n = 0; n < 21; ++n) all.add(0.37 * n, 2);
  all.doubtful();
  for (std::size_t n = 0; n < 21; ++n) {
    const auto &a = all.points[4 * n], &b = all.points[4 * n + 1];
    const double dx = a[0] - b[0], dy = a[1] - b[1];
    EXPECT_EQ(all.square[n], dx * dx + dy * dy);
  }
}

TEST(CrossedLimit, IsToldOfEachEdgeOnce) {
  for (int count = 0; count < 40; ++count) {
    const auto padded = static_cast<std::size_t>(count + Lanes<double>::width);
    std::vector<double> square(padded, 5), was_beyond(padded, 0);
    std::vector<std::int32_t> expected, changed(padded);
    for (int n = 0; n < count; ++n) {
      const auto e = static_cast<std::size_t>(n);
      square[e] = std::array{1.0, 2.0, 3.0}[e % 3];  // at the limit: not beyond it
      was_beyond[e] = n % 5 < 2 ? 1 : 0;
      if ((square[e] > 2) != (was_beyond[e] > 0)) expected.push_back(n);
    }
    changed.resize(static_cast<std::size_t>(
        crossed_limit(square.data(), 2, was_beyond.data(), count, changed.data())));
    EXPECT_EQ(changed, expected);
  }
}

}  // namespace
}  // namespace metamorph::kernels
