#include "kernels/reference/self_collision.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/kernels/points.h"

namespace metamorph::tests {
namespace {

/// One node above an edge from (0, 0) to (2, 0), far from each other at rest unless said.
struct NodeAndEdge {
  NodeAndEdge(double x, double y) : points(3) {
    points.x = {0, 2, x};
    points.y = {0, 0, y};
  }
  void add(double threshold, std::vector<double>& fx, std::vector<double>& fy) const {
    const std::vector<ref::CollisionPair> pairs = {{2, {0, 1}, threshold}};
    ref::add_collision_forces(pairs, 2.0, points.nodes(), {fx, fy});
  }
  Points points;
};

TEST(SelfCollision, PushesByTheGapAndSharesBarycentrically) {
  std::vector<double> fx(3), fy(3);
  NodeAndEdge(0.5, 0.25).add(0.375, fx, fy);  // exact in binary
  EXPECT_EQ(fy[2], 2.0 * 0.125);
  EXPECT_EQ(fy[0], -0.75 * 0.25);
  EXPECT_EQ(fy[1], -0.25 * 0.25);
  EXPECT_EQ(fx, (std::vector<double>{0, 0, 0}));
}

TEST(SelfCollision, BeyondTheEdgeTheEndIsTheClosestPoint) {
  std::vector<double> fx(3), fy(3);
  NodeAndEdge(2.25, 0).add(0.375, fx, fy);
  EXPECT_EQ(fx, (std::vector<double>{0, -0.25, 0.25}));
}

TEST(SelfCollision, NothingAtOrAboveTheThresholdNorOnTheEdge) {
  std::vector<double> fx(3), fy(3);
  NodeAndEdge(1, 0.375).add(0.375, fx, fy);
  NodeAndEdge(1, 0.0).add(0.375, fx, fy);
  EXPECT_EQ(fx, (std::vector<double>{0, 0, 0}));
  EXPECT_EQ(fy, (std::vector<double>{0, 0, 0}));
}

}  // namespace
}  // namespace metamorph::tests
