#include "kernels/reference/self_collision.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "core/body.h"
#include "tests/bodies.h"
#include "tests/kernels/points.h"
#include "tests/tolerance.h"

namespace metamorph::tests {
namespace {

/// Edges that walks along the outline from `node` take as their first and second, by walking:
/// every choice at every node, in both directions, never straight back along the same edge.
std::set<std::size_t> walked(int node, const std::vector<ref::Edge>& outline) {
  std::set<std::size_t> edges;
  for (std::size_t first = 0; first < outline.size(); ++first)
    for (int end = 0; end < 2; ++end) {
      if (outline[first][static_cast<std::size_t>(end)] != node) continue;
      edges.insert(first);
      const int middle = outline[first][static_cast<std::size_t>(1 - end)];
      for (std::size_t second = 0; second < outline.size(); ++second)
        if (second != first && (outline[second][0] == middle || outline[second][1] == middle))
          edges.insert(second);
    }
  return edges;
}

TEST(SelfCollision, LeavesOutTheEdgesWithinTwoHops) {
  // A disc, a ring with two outlines, and two triangles that touch in one node.
  std::vector<std::vector<ref::Edge>> outlines = {
      core::outline_of(disc_body(19).triangles), core::outline_of(ring_body(2, 4).triangles),
      core::outline_of({{0, 1, 2}, {2, 3, 4}}), core::outline_of({{0, 1, 2}})};
  for (const auto& outline : outlines) {
    std::set<int> nodes;
    for (const ref::Edge& edge : outline) nodes.insert(edge[0]);
    for (const int node : nodes) {
      const std::set<std::size_t> expected = walked(node, outline);
      for (std::size_t e = 0; e < outline.size(); ++e)
        EXPECT_EQ(ref::within_two_hops(node, outline[e], outline), expected.count(e) == 1)
            << "node " << node << " edge " << e;
    }
  }
}

TEST(SelfCollision, ASimpleOutlineLeavesOutFourEdgesPerNode) {
  const auto outline = core::outline_of(disc_body(61).triangles);
  for (const ref::Edge& start : outline) {
    int left_out = 0;
    for (const ref::Edge& edge : outline) left_out += ref::within_two_hops(start[0], edge, outline);
    EXPECT_EQ(left_out, 4);
  }
}

/// One node above an edge from (0, 0) to (2, 0), far from each other at rest unless said.
struct NodeAndEdge {
  NodeAndEdge(double x, double y) : points(3) {
    points.x = {0, 2, x};
    points.y = {0, 0, y};
  }
  void add(double threshold, std::vector<double>& fx, std::vector<double>& fy) const {
    const std::vector<int> nodes = {2};
    const std::vector<ref::Edge> edges = {{0, 1}};
    const std::vector<double> thresholds = {threshold};
    ref::add_collision_forces({nodes, edges, thresholds}, 2.0, points.nodes(), {fx, fy});
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

TEST(SelfCollision, NothingAtOrAboveTheThresholdNorOnTheEdgeNorOnLeftOutPairs) {
  std::vector<double> fx(3), fy(3);
  NodeAndEdge(1, 0.375).add(0.375, fx, fy);
  NodeAndEdge(1, 0.0).add(0.375, fx, fy);
  NodeAndEdge(1, 0.25).add(0.0, fx, fy);
  EXPECT_EQ(fx, (std::vector<double>{0, 0, 0}));
  EXPECT_EQ(fy, (std::vector<double>{0, 0, 0}));
}

TEST(SelfCollision, PairsThatAreCloserAtRestKeepTheirDistance) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const core::Body body = blob_body(60, seed);
    const auto outline = core::outline_of(body.triangles);
    std::vector<int> nodes;
    for (const ref::Edge& edge : outline) nodes.push_back(edge[0]);
    std::vector<double> threshold(nodes.size() * outline.size());
    ref::set_collision_thresholds(nodes, outline, 1.5, body.x, body.y, threshold);
    int narrowed = 0;
    for (const double t : threshold) {
      EXPECT_LE(t, 1.5);
      narrowed += t > 0 && t < 1.5;
    }
    EXPECT_GT(narrowed, 0);
    std::vector<double> fx(body.x.size()), fy(body.x.size()), still(body.x.size());
    ref::add_collision_forces({nodes, outline, threshold}, 2.0, {body.x, body.y, still, still},
                              {fx, fy});
    for (std::size_t i = 0; i < fx.size(); ++i) {
      EXPECT_EQ(fx[i], 0);
      EXPECT_EQ(fy[i], 0);
    }
  }
}

}  // namespace
}  // namespace metamorph::tests
