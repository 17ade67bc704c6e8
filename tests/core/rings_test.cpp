// Rings hold every spring twice, every triangle three times, every outline edge twice.

#include "core/locomotion/rings.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "tests/bodies.h"

namespace metamorph::core {
namespace {

void expect_complete(const Body& body) {
  const Rings rings = make_rings(body);
  std::vector<int> springs(body.springs.size()), triangles(body.triangles.size());
  ASSERT_EQ(rings.begin.size(), body.x.size() + 1);
  ASSERT_EQ(rings.closing.size(), body.x.size());
  for (Index node = 0; node < body.node_count(); ++node) {
    const auto n = static_cast<std::size_t>(node);
    const auto count_triangle = [&](Index triangle, Index before, Index after) {
      // node, before, after counter-clockwise: some rotation of the triangle.
      const auto [a, b, c] = body.triangles[static_cast<std::size_t>(triangle)];
      const std::array corner = {node, before, after};
      EXPECT_TRUE((corner == std::array{a, b, c}) || (corner == std::array{b, c, a}) ||
                  (corner == std::array{c, a, b}))
          << "node " << node;
      ++triangles[static_cast<std::size_t>(triangle)];
    };
    const auto slot_at = [&](int k) { return rings.slots[static_cast<std::size_t>(k)]; };
    const RingSlot first = slot_at(rings.begin[n]), last = slot_at(rings.begin[n + 1] - 1);
    EXPECT_EQ(first.triangle, -1);
    for (int k = rings.begin[n]; k < rings.begin[n + 1]; ++k) {
      const RingSlot slot = slot_at(k);
      const auto spring = body.springs[static_cast<std::size_t>(slot.spring)];
      EXPECT_TRUE((spring == std::array{node, slot.neighbour}) ||
                  (spring == std::array{slot.neighbour, node}));
      ++springs[static_cast<std::size_t>(slot.spring)];
      if (slot.triangle >= 0)
        count_triangle(slot.triangle, slot_at(k - 1).neighbour, slot.neighbour);
    }
    if (rings.closing[n] >= 0) count_triangle(rings.closing[n], last.neighbour, first.neighbour);
    if (rings.edges(node) > 0) {
      EXPECT_EQ(rings.edge_other[static_cast<std::size_t>(rings.edge_begin[n])], first.neighbour);
      EXPECT_EQ(rings.edge_other[static_cast<std::size_t>(rings.edge_begin[n + 1]) - 1],
                last.neighbour);
    }
  }
  for (const int count : springs) EXPECT_EQ(count, 2);
  for (const int count : triangles) EXPECT_EQ(count, 3);
  EXPECT_EQ(rings.edge_other.size(), 2 * outline_of(body.triangles).size());
}

TEST(Rings, AreCompleteInBodiesOfEveryShape) {
  expect_complete(tests::triangle_body());
  expect_complete(tests::hexagon_body());
  expect_complete(tests::strip_body(9));
  expect_complete(tests::disc_body(61));
  expect_complete(tests::ring_body(2, 5));
  for (std::uint64_t seed = 1; seed <= 20; ++seed) expect_complete(tests::blob_body(80, seed));
}

TEST(Rings, HoldOneFanAfterTheOtherAtAPinch) {
  // Two triangles that share node 2 and nothing else.
  Body body;
  body.x = {0, 1, 0.5, 0, 1};
  body.y = {0, 0, 1, 2, 2};
  body.triangles = {{0, 1, 2}, {2, 4, 3}};
  body.springs = edges_of(body.triangles);
  expect_complete(body);
  const Rings rings = make_rings(body);
  EXPECT_EQ(rings.size(2), 4);
  EXPECT_EQ(rings.edges(2), 4);
  EXPECT_EQ(rings.inner_edges(2), 2);
  EXPECT_EQ(rings.closing[2], -1);
}

TEST(Rings, OfAnInnerNodeCloseOnItself) {
  const Body body = tests::hexagon_body();
  const Rings rings = make_rings(body);
  int closed = 0;
  for (Index node = 0; node < body.node_count(); ++node) {
    if (rings.closing[static_cast<std::size_t>(node)] < 0) continue;
    ++closed;
    EXPECT_EQ(rings.size(node), 6);
    EXPECT_EQ(rings.edges(node), 0);
  }
  EXPECT_EQ(closed, 1);
}

}  // namespace
}  // namespace metamorph::core
