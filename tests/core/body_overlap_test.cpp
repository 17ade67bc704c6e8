// Bodies whose outline crosses itself or whose parts overlap, as check() sees them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/body/outline_crossing.h"
#include "metamorph/body.h"
#include "tests/bodies.h"

namespace metamorph::core {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::string> texts(const std::vector<BodyFault>& faults) {
  std::vector<std::string> result;
  for (const BodyFault& fault : faults) result.push_back(fault.what);
  return result;
}

/// A strip of triangles wound around the origin, from radius `inner` on, which it leaves by `rise`
/// per turn.
Body wound_strip(int segments, double turns, double inner, double rise) {
  Body body;
  for (int i = 0; i <= segments; ++i) {
    const double turn = turns * i / segments, angle = 2 * std::numbers::pi * turn;
    for (const double radius : {inner + rise * turn, inner + 1 + rise * turn}) {
      body.x.push_back(radius * std::cos(angle));
      body.y.push_back(radius * std::sin(angle));
    }
    if (i == segments) break;
    const Index n = 2 * i;
    body.triangles.push_back({n, n + 1, n + 2});
    body.triangles.push_back({n + 1, n + 3, n + 2});
  }
  set_rest_from_nodes(body);
  tests::set_wave(body);
  return body;
}

TEST(CheckOverlap, AWoundStripMayPassItselfButNotCross) {
  EXPECT_THAT(texts(check(wound_strip(60, 1.5, 3, 1.4))), IsEmpty());
  const auto faults = check(wound_strip(60, 1.5, 3, 0.55));
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].status, Status::bad_geometry);
  EXPECT_THAT(faults[0].what, HasSubstr("outline edges ["));
  EXPECT_THAT(faults[0].what,
              HasSubstr(": cross: expected an outline that neither crosses nor touches itself"));
}

TEST(CheckOverlap, ANodeOnAnEdgeAndAFoldAreNamed) {
  // A triangle's tip reaches the opposite jaw of a C.
  Body body;
  body.x = {0, 4, 4, 1, 1, 4, 4, 0};
  body.y = {0, 0, 1, 1, 3, 3, 4, 4};
  body.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 7}, {7, 4, 5}, {7, 5, 6}};
  body.x.push_back(2);
  body.y.push_back(2);
  body.triangles.push_back({4, 8, 5});
  set_rest_from_nodes(body);
  tests::set_wave(body);
  EXPECT_THAT(texts(check(body)), IsEmpty());
  body.y[8] = 1;
  EXPECT_THAT(texts(check(body)),
              testing::ElementsAre("outline edges [2, 3] and [4, 8]: node 8 lies on both: expected "
                                   "an outline that neither crosses nor touches itself"));
  // The same tip folded onto the jaw it hangs from.
  body.x[8] = 1;
  body.y[8] = 2;
  EXPECT_THAT(texts(check(body)),
              testing::ElementsAre(HasSubstr("outline edges [3, 4] and [4, 8]: node 8 lies on "
                                             "both")));
}

TEST(CheckOverlap, PinchesAndHolesAreLegal) {
  EXPECT_THAT(texts(check(tests::pinched_body())), IsEmpty());
  EXPECT_THAT(texts(check(tests::ring_body(2, 5))), IsEmpty());
}

/// Two discs of radius 3 cut along two edges through their centre and sewn together crosswise: the
/// triangles around either end of the cut turn twice around it, and the outer disc's outline lies
/// around the inner one's. Nodes 0 and 1 are the ends of the cut.
Body twofold_disc() {
  const Body disc = tests::disc_body(37);
  const auto is = [&](Index n, double x, double y) {
    return disc.x[static_cast<std::size_t>(n)] == x && disc.y[static_cast<std::size_t>(n)] == y;
  };
  Body body;
  body.x = {-1, 1};
  body.y = {0, 0};
  std::array<std::vector<Index>, 2> node;
  for (int sheet = 0; sheet < 2; ++sheet) {
    for (Index n = 0; n < disc.node_count(); ++n) {
      if (is(n, -1, 0) || is(n, 1, 0)) {
        node[static_cast<std::size_t>(sheet)].push_back(is(n, -1, 0) ? 0 : 1);
        continue;
      }
      const double grown = sheet == 0 ? 1 : 1.07;
      node[static_cast<std::size_t>(sheet)].push_back(body.node_count());
      body.x.push_back(grown * disc.x[static_cast<std::size_t>(n)]);
      body.y.push_back(grown * disc.y[static_cast<std::size_t>(n)] + 0.02 * sheet);
    }
  }
  for (std::size_t sheet = 0; sheet < 2; ++sheet) {
    for (const auto& triangle : disc.triangles) {
      double y = 0;
      for (const Index n : triangle) y += disc.y[static_cast<std::size_t>(n)];
      std::array<Index, 3> sewn{};
      for (std::size_t c = 0; c < 3; ++c) {
        // Below the cut its middle is the other sheet's.
        const bool other = is(triangle[c], 0, 0) && y < 0;
        sewn[c] = node[other ? 1 - sheet : sheet][static_cast<std::size_t>(triangle[c])];
      }
      body.triangles.push_back(sewn);
    }
  }
  set_rest_from_nodes(body);
  tests::set_wave(body);
  return body;
}

TEST(CheckOverlap, TrianglesTurnOnceAroundANode) {
  const Body body = twofold_disc();
  const auto outline = outline_of(body.triangles);
  EXPECT_FALSE(first_crossing(body.x, body.y, outline));
  const auto faults = check(body);
  EXPECT_THAT(texts(faults),
              testing::ElementsAre("nodes[0]: its triangles lie on each other: expected triangles "
                                   "that turn around it once",
                                   "nodes[1]: its triangles lie on each other: expected triangles "
                                   "that turn around it once",
                                   HasSubstr("within or around another part of the body")));
  EXPECT_EQ(status_of(faults), Status::bad_geometry);
}

TEST(CheckOverlap, PartsThatOverlapWithoutCrossingAreNamed) {
  // Without a triangle at either end of the cut the nodes there lie on the outline.
  Body body = twofold_disc();
  for (const Index end : {0, 1}) {
    const auto hangs = [&](const auto& t) { return std::count(t.begin(), t.end(), end) > 0; };
    body.triangles.erase(std::find_if(body.triangles.begin(), body.triangles.end(), hangs));
  }
  set_rest_from_nodes(body);
  EXPECT_FALSE(first_crossing(body.x, body.y, outline_of(body.triangles)));
  EXPECT_THAT(texts(check(body)), Contains(HasSubstr("within or around another part of the body: "
                                                     "expected parts that do not overlap")));
}

}  // namespace
}  // namespace metamorph::core
