#include "core/locomotion/solid_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

#include "core/locomotion/segment_distance.h"
#include "kernels/reference/self_collision.h"
#include "metamorph/body.h"
#include "metamorph/scene.h"
#include "tests/bodies.h"
#include "tests/tolerance.h"

// What may not pass through what, against the rule said plainly.

namespace metamorph::tests {
namespace {

namespace ref = kernels::reference;

bool on_outline(const std::vector<std::array<core::Index, 2>>& outline, core::Index node) {
  return std::any_of(outline.begin(), outline.end(),
                     [=](const auto& edge) { return edge[0] == node; });
}

TEST(SolidPairs, AreAllNodesAndEdgesOfTheOutlineWithoutACommonEnd) {
  core::Scene scene;
  scene.min_pressure_area = 0;
  for (const core::Body& body : {disc_body(19), ring_body(2, 4), pinched_body(), jaws_body(),
                                 blob_body(40, 3), triangle_body()}) {
    const auto outline = core::outline_of(body.triangles);
    std::set<std::array<core::Index, 3>> expected, found;
    for (const auto& edge : outline)
      for (core::Index node = 0; node < body.node_count(); ++node)
        if (on_outline(outline, node) && node != edge[0] && node != edge[1])
          expected.insert({edge[0], edge[1], node});
    std::vector<std::array<core::Index, 3>> in_order;
    for (const core::SolidPair& pair : core::solid_pairs(body, scene)) {
      in_order.push_back({pair.edge[0], pair.edge[1], pair.node});
      EXPECT_GT(pair.threshold, 0);
      EXPECT_EQ(pair.threshold,
                std::min(scene.collision_gap,
                         core::distance_from_edge(body.x, body.y, pair.node, pair.edge)));
    }
    found.insert(in_order.begin(), in_order.end());
    EXPECT_EQ(found.size(), in_order.size()) << "a pair twice";
    EXPECT_EQ(found, expected);
    EXPECT_TRUE(std::is_sorted(in_order.begin(), in_order.end()));
  }
}

TEST(SolidPairs, ATriangleWithoutPressureIsKeptByItsCorners) {
  // The smallest area is chosen so that some triangles inside and on the rim have none.
  const core::Body body = blob_body(40, 3);
  core::Scene scene;
  scene.min_pressure_area = 0.42;
  const auto outline = core::outline_of(body.triangles);
  std::set<std::array<core::Index, 3>> all;
  const auto pairs = core::solid_pairs(body, scene);
  for (const core::SolidPair& pair : pairs) all.insert({pair.edge[0], pair.edge[1], pair.node});
  EXPECT_EQ(all.size(), pairs.size()) << "a pair twice";
  std::size_t small = 0;
  for (std::size_t t = 0; t < body.triangles.size(); ++t) {
    if (body.rest_area[t] >= scene.min_pressure_area) continue;
    ++small;
    const auto [a, b, c] = body.triangles[t];
    for (const auto& corner : {std::array{b, c, a}, std::array{c, a, b}, std::array{a, b, c}})
      EXPECT_EQ(all.count(corner), 1u) << "triangle " << t;
  }
  EXPECT_GT(small, 0u);
  EXPECT_LT(small, body.triangles.size());
  const auto corners = core::corners_without_pressure(body, scene);
  EXPECT_GT(corners.size(), 0u);
  scene.min_pressure_area = 0;
  EXPECT_EQ(core::solid_pairs(body, scene).size() + corners.size(), pairs.size());
  EXPECT_TRUE(core::corners_without_pressure(body, scene).empty());
}

TEST(SolidPairs, RestWithoutForceWhateverTheGap) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const core::Body body = blob_body(60, seed);
    core::Scene scene;
    scene.collision_gap = 1.5;
    std::vector<ref::CollisionPair> pairs;
    int narrowed = 0;
    for (const core::SolidPair& pair : core::solid_pairs(body, scene)) {
      pairs.push_back({pair.node, pair.edge, pair.threshold});
      narrowed += pair.threshold < scene.collision_gap;
    }
    EXPECT_GT(narrowed, 0);
    std::vector<double> fx(body.x.size()), fy(body.x.size()), still(body.x.size());
    ref::add_collision_forces(pairs, 4.0, {body.x, body.y, still, still}, {fx, fy});
    // A threshold is a distance of up to 1.5 d between places of up to 16 d, rounded; so is a gap.
    const double rounding = tolerance::sum(round_off_64, 8) * 16 * 4.0 * 16;
    for (std::size_t i = 0; i < fx.size(); ++i)
      EXPECT_TRUE(within(std::hypot(fx[i], fy[i]), rounding));
  }
}

}  // namespace
}  // namespace metamorph::tests
