#include "metamorph/metrics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/evolve/random_genomes.h"

namespace metamorph::evolve {
namespace {

using testing::test_stream;
using Points = std::vector<std::vector<double>>;

TEST(MapWorth, ByHand) {
  const MapWorth worth = map_worth(std::vector<double>{3, 1, 0}, 12);
  EXPECT_EQ(worth.filled, 3);
  EXPECT_EQ(worth.coverage, 0.25);
  EXPECT_EQ(worth.qd_score, 4);
  EXPECT_EQ(worth.best, 3);
  EXPECT_EQ(worth.mean, 4.0 / 3);
  // An offset of -1 counts each filled niche once more.
  EXPECT_EQ(map_worth(std::vector<double>{3, 1, 0}, 12, -1).qd_score, 7);
  EXPECT_EQ(map_worth(std::vector<double>{-3, -1}, 12, -4).best, -1);
  const MapWorth nothing = map_worth({}, 12);
  EXPECT_EQ(nothing.filled, 0);
  EXPECT_EQ(nothing.coverage, 0);
  EXPECT_EQ(nothing.qd_score, 0);
  EXPECT_EQ(nothing.best, 0);
}

/// The volume of a union of boxes as the sum over all subsets, with alternating signs.
double by_inclusion_and_exclusion(const Points& points, const std::vector<double>& reference) {
  double volume = 0;
  for (unsigned subset = 1; subset < (1u << points.size()); ++subset) {
    std::vector<double> corner(reference.size(), std::numeric_limits<double>::infinity());
    int members = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
      if ((subset >> p & 1u) == 0) continue;
      ++members;
      for (std::size_t c = 0; c < corner.size(); ++c) {
        corner[c] = std::min(corner[c], points[p][c]);
      }
    }
    double box = members % 2 == 1 ? 1 : -1;
    for (std::size_t c = 0; c < corner.size(); ++c) box *= std::max(0.0, corner[c] - reference[c]);
    volume += box;
  }
  return volume;
}

TEST(Hypervolume, ByHand) {
  const std::vector<double> origin = {0, 0};
  EXPECT_EQ(hypervolume({}, origin), 0);
  EXPECT_EQ(hypervolume({{2, 3}}, origin), 6);
  EXPECT_EQ(hypervolume({{1, 3}, {3, 1}}, origin), 5);
  EXPECT_EQ(hypervolume({{3, 1}, {1, 3}, {1, 3}, {1, 1}}, origin), 5);
  EXPECT_EQ(hypervolume({{2, 3}}, std::vector<double>{1, 1}), 2);
  EXPECT_EQ(hypervolume({{2, 3}, {0.5, 9}}, std::vector<double>{1, 1}), 2);  // not above it
  EXPECT_EQ(hypervolume({{4}, {7}}, std::vector<double>{2}), 5);
  // Three slabs of a unit cube's corner: 1 - (1/2)^3 where each lacks a half of one axis.
  EXPECT_EQ(hypervolume({{0.5, 1, 1}, {1, 0.5, 1}, {1, 1, 0.5}}, std::vector<double>{0, 0, 0}),
            0.875);
}

TEST(Hypervolume, AgreesWithInclusionAndExclusion) {
  RandomStream stream = test_stream(31);
  for (std::size_t coordinates = 1; coordinates <= 5; ++coordinates) {
    for (int round = 0; round < 40; ++round) {
      Points points(1 + stream.below(9));
      for (std::vector<double>& point : points) {
        for (std::size_t c = 0; c < coordinates; ++c) {
          // On a grid in part, so that coordinates and whole points are equal now and then.
          const double x = 4 * stream.uniform();
          point.push_back(round % 2 == 0 ? x : std::floor(x));
        }
      }
      std::vector<double> reference(coordinates, 0.0);
      if (round % 3 == 0) reference.assign(coordinates, 0.5);
      const double expected = by_inclusion_and_exclusion(points, reference);
      // 2^9 terms of at most 4^5 that cancel.
      EXPECT_NEAR(hypervolume(points, reference), expected, 512 * 1024 * 0x1p-52);
      std::reverse(points.begin(), points.end());
      EXPECT_NEAR(hypervolume(points, reference), expected, 512 * 1024 * 0x1p-52);
    }
  }
}

// The staircase below n points of a line from (0, 1) to (1, 0) has the area (1 - 1/n) / 2.
TEST(Hypervolume, OfManyPoints) {
  const int n = 300;
  Points points;
  for (int i = 0; i <= n; ++i) points.push_back({i / double{n}, (n - i) / double{n}});
  EXPECT_NEAR(hypervolume(points, std::vector<double>{0, 0}), (1 - 1.0 / n) / 2, 1e-13);
}

}  // namespace
}  // namespace metamorph::evolve
