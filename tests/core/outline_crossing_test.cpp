#include "core/body/outline_crossing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ostream>

#include "metamorph/random.h"

namespace metamorph::core {

static std::ostream& operator<<(std::ostream& out, const OutlineCrossing& c) {
  return out << c.edges[0] << ", " << c.edges[1] << ": " << static_cast<int>(c.meeting) << " at "
             << c.node;
}

namespace {

using ::testing::Contains;

using Edges = std::vector<std::array<Index, 2>>;

/// A closed walk through all nodes in order.
Edges closed(std::size_t nodes) {
  Edges edges;
  for (std::size_t i = 0; i < nodes; ++i) {
    edges.push_back({static_cast<Index>(i), static_cast<Index>((i + 1) % nodes)});
  }
  return edges;
}

std::optional<OutlineCrossing> crossing_of(const std::vector<double>& x,
                                           const std::vector<double>& y) {
  return first_crossing(x, y, closed(x.size()));
}

void expect_meeting(const std::optional<OutlineCrossing>& found, std::array<Index, 2> edges,
                    Meeting meeting, Index node) {
  ASSERT_TRUE(found);
  EXPECT_EQ(found->edges, edges) << *found;
  EXPECT_EQ(found->meeting, meeting) << *found;
  EXPECT_EQ(found->node, node) << *found;
}

TEST(OutlineCrossing, ConvexAndBentPolygonsHaveNone) {
  EXPECT_FALSE(crossing_of({0, 1, 1, 0}, {0, 0, 1, 1}));
  EXPECT_FALSE(crossing_of({0, 4, 4, 3, 3, 1, 1, 0}, {0, 0, 4, 4, 1, 1, 4, 4}));
  EXPECT_FALSE(crossing_of({0, 1, 2, 2, 1, 0}, {0, 0, 0, 1, 1, 1}));  // straight on is no fold
}

TEST(OutlineCrossing, EveryWayToMeetIsFound) {
  expect_meeting(crossing_of({0, 1, 0, 1}, {0, 0, 1, 1}), {1, 3}, Meeting::crossing, -1);
  // A node on an edge, then an ulp away from it.
  const std::vector<double> x = {0, 4, 4, 2, 0};
  expect_meeting(crossing_of(x, {0, 0, 3, 0, 3}), {0, 2}, Meeting::touching, 3);
  EXPECT_FALSE(crossing_of(x, {0, 0, 3, 5e-324, 3}));
  expect_meeting(crossing_of(x, {0, 0, 3, -5e-324, 3}), {0, 2}, Meeting::crossing, -1);
  // Nodes that coincide.
  expect_meeting(crossing_of({0, 4, 4, 0, 0}, {0, 0, 3, 0, 3}), {0, 2}, Meeting::touching, 0);
  // Edges on one line: overlapping, one within the other, one behind the other.
  const std::vector<double> y = {0, 0, 1, 0, 0, 1};
  expect_meeting(crossing_of({0, 3, 5, 4, 2, 0}, y), {0, 3}, Meeting::touching, 1);
  expect_meeting(crossing_of({0, 4, 5, 3, 2, 0}, y), {0, 2}, Meeting::touching, 3);
  EXPECT_FALSE(crossing_of({0, 2, 2, 3, 4, 5}, {0, 0, 1, 0, 0, 9}));
  // Folded back: the end of the shorter lies on the longer, whichever comes first.
  expect_meeting(crossing_of({0, 2, 1, 0}, {0, 2, 1, 3}), {0, 1}, Meeting::touching, 2);
  expect_meeting(crossing_of({1, 2, 0, 0}, {1, 2, 0, 3}), {0, 1}, Meeting::touching, 0);
  expect_meeting(crossing_of({2, 2, 2, 0}, {0, 2, 1, 3}), {0, 1}, Meeting::touching, 2);
}

TEST(OutlineCrossing, TheLowestPairIsTold) {
  // A pentagram: each edge crosses the next but one and the one after.
  std::vector<double> x, y;
  for (int i = 0; i < 5; ++i) {
    x.push_back(std::cos(0.8 * std::numbers::pi * i));
    y.push_back(std::sin(0.8 * std::numbers::pi * i));
  }
  expect_meeting(crossing_of(x, y), {0, 2}, Meeting::crossing, -1);
}

/// Two triangles that hang together in node 0: the second's other nodes lie at (x, y).
std::optional<OutlineCrossing> pinch(std::array<double, 2> a, std::array<double, 2> b) {
  const std::vector<double> x = {0, 4, 0, a[0], b[0]}, y = {0, 0, 4, a[1], b[1]};
  const Edges edges = {{0, 1}, {0, 3}, {1, 2}, {2, 0}, {3, 4}, {4, 0}};
  return first_crossing(x, y, edges);
}

TEST(OutlineCrossing, PinchesAreNoneAsLongAsTheirPartsLieApart) {
  EXPECT_FALSE(pinch({-1, 0}, {0, -1}));
  EXPECT_FALSE(pinch({-1, 2}, {-2, -1}));
  expect_meeting(pinch({2, 1}, {1, 2}), {0, 1}, Meeting::pinch, 0);       // one within the other
  expect_meeting(pinch({1, 2}, {-1, 1}), {3, 4}, Meeting::crossing, -1);  // half
}

TEST(OutlineCrossing, OverlapIsFoundWithoutCrossing) {
  const std::vector<double> square = {0, 6, 6, 0, 2, 4, 4, 2}, up = {0, 0, 6, 6, 2, 2, 4, 4};
  const auto overlap = [&](bool outer_left, bool inner_left) {
    Edges edges;
    for (const auto& [a, b] : closed(4)) {
      edges.push_back(outer_left ? std::array{a, b} : std::array{b, a});
    }
    for (const auto& [a, b] : closed(4)) {
      edges.push_back(inner_left ? std::array{a + 4, b + 4} : std::array{b + 4, a + 4});
    }
    EXPECT_FALSE(first_crossing(square, up, edges));
    return first_overlap(square, up, edges);
  };
  EXPECT_FALSE(overlap(true, false));  // a ring
  EXPECT_EQ(overlap(true, true), 4);   // a body on a body
  EXPECT_TRUE(overlap(false, true));
  EXPECT_TRUE(overlap(false, false));
}

// Brute force on whole numbers, where products are exact.

struct Vector {
  std::int64_t x, y;
};
Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y}; }
std::int64_t cross(Vector a, Vector b) { return a.x * b.y - a.y * b.x; }
std::int64_t dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y; }

struct Walk {
  std::vector<Vector> at;
  Edges edges;
};

/// By the parameters of the point in which the lines meet.
bool meet(const Walk& w, std::array<Index, 2> e, std::array<Index, 2> f) {
  const auto at = [&](Index i) { return w.at[static_cast<std::size_t>(i)]; };
  if (e[0] == f[1]) std::swap(e, f);
  if (e[1] == f[0]) {
    if (e[0] == f[1]) return true;
    const Vector back = at(e[0]) - at(e[1]), on = at(f[1]) - at(f[0]);
    return cross(back, on) == 0 && dot(back, on) > 0;
  }
  if (e[0] == f[0] || e[1] == f[1]) {
    const std::size_t common = e[0] == f[0] ? 0 : 1;
    if (e[1 - common] == f[1 - common]) return true;
    const Vector one = at(e[1 - common]) - at(e[common]), other = at(f[1 - common]) - at(e[common]);
    return cross(one, other) == 0 && dot(one, other) > 0;
  }
  const Vector p = at(e[0]), r = at(e[1]) - p, q = at(f[0]), s = at(f[1]) - q;
  const std::int64_t both = cross(r, s), t = cross(q - p, s), u = cross(q - p, r);
  if (both != 0) {
    const auto within = [&](std::int64_t v) {
      return both > 0 ? 0 <= v && v <= both : both <= v && v <= 0;
    };
    return within(t) && within(u);
  }
  if (u != 0) return false;
  // On one line: where f's ends lie along e, which runs from 0 to dot(r, r).
  const auto [first, last] = std::minmax({dot(q - p, r), dot(at(f[1]) - p, r)});
  return first <= dot(r, r) && last >= 0;
}

std::optional<std::array<Index, 2>> lowest_pair(const Walk& w) {
  for (std::size_t e = 0; e < w.edges.size(); ++e) {
    for (std::size_t f = e + 1; f < w.edges.size(); ++f) {
      if (meet(w, w.edges[e], w.edges[f])) {
        return std::array{static_cast<Index>(e), static_cast<Index>(f)};
      }
    }
  }
  return std::nullopt;
}

/// By angles, which differ by more than their round-off between points of a small grid.
bool is_entangled(const Walk& w) {
  for (std::size_t n = 0; n < w.at.size(); ++n) {
    std::vector<std::pair<double, bool>> around;
    for (const auto& [a, b] : w.edges) {
      for (const auto& [here, there] : {std::pair(a, b), std::pair(b, a)}) {
        if (here != static_cast<Index>(n)) continue;
        const Vector to = w.at[static_cast<std::size_t>(there)] - w.at[n];
        around.emplace_back(std::atan2(to.y, to.x), here == a);
      }
    }
    std::sort(around.begin(), around.end());
    for (std::size_t i = 0; i < around.size(); ++i) {
      if (around[i].second == around[(i + 1) % around.size()].second) return true;
    }
  }
  return false;
}

/// On an even grid, of an edge: how often the others wind around what lies right of its middle.
int winding_on_the_right(Walk w, std::array<Index, 2> edge) {
  const auto at = [&](Index i) { return w.at[static_cast<std::size_t>(i)]; };
  if (at(edge[0]).x == at(edge[1]).x) {
    for (Vector& v : w.at) v = {-v.y, v.x};
  }
  const Vector along = at(edge[1]) - at(edge[0]);
  const Vector middle = {(at(edge[0]).x + at(edge[1]).x) / 2, (at(edge[0]).y + at(edge[1]).y) / 2};
  int winding = along.x > 0 ? 0 : -1;  // beneath the edge, or above it
  for (const auto& [a, b] : w.edges) {
    const bool right = at(a).x < at(b).x;
    const Vector low = right ? at(a) : at(b), high = right ? at(b) : at(a);
    if (!(low.x <= middle.x && middle.x < high.x)) continue;
    if (cross(high - low, middle - low) > 0) winding += right ? 1 : -1;
  }
  return winding;
}

std::pair<std::vector<double>, std::vector<double>> coordinates(const Walk& w, double unit) {
  std::vector<double> x, y;
  for (const Vector& v : w.at) {
    x.push_back(static_cast<double>(v.x) * unit);
    y.push_back(static_cast<double>(v.y) * unit);
  }
  return {x, y};
}

Vector random_point(evolve::RandomStream& random, std::uint32_t grid) {
  return {2 * static_cast<std::int64_t>(random.below(grid)),
          2 * static_cast<std::int64_t>(random.below(grid))};
}

/// One closed walk that may come through a node more than once, no edge of it without length.
Walk random_walk(evolve::RandomStream& random) {
  const std::uint32_t nodes = 3 + random.below(6), grid = 3 + random.below(8);
  Walk walk;
  for (std::uint32_t n = 0; n < nodes; ++n) walk.at.push_back(random_point(random, grid));
  const std::size_t length = 3 + random.below(6);
  std::vector<Index> order;
  while (order.size() < length) order.push_back(static_cast<Index>(random.below(nodes)));
  for (std::size_t i = 0; i < length; ++i) {
    const std::array<Index, 2> edge = {order[i], order[(i + 1) % length]};
    const Vector along =
        walk.at[static_cast<std::size_t>(edge[1])] - walk.at[static_cast<std::size_t>(edge[0])];
    if (dot(along, along) == 0) return random_walk(random);
    walk.edges.push_back(edge);
  }
  return walk;
}

TEST(OutlineCrossing, AgreesWithBruteForceOnRandomWalks) {
  evolve::RandomStream random(evolve::Purpose::test, 41, 0, 0);
  int met = 0, entangled = 0, clear = 0;
  for (int i = 0; i < 60000; ++i) {
    const Walk walk = random_walk(random);
    const auto [x, y] = coordinates(walk, i % 2 == 0 ? 1.0 : 0x1.8p-30);
    const auto found = first_crossing(x, y, walk.edges);
    if (const auto expected = lowest_pair(walk)) {
      ++met;
      ASSERT_TRUE(found && found->meeting != Meeting::pinch);
      EXPECT_EQ(found->edges, *expected) << *found;
    } else if (is_entangled(walk)) {
      ++entangled;
      ASSERT_TRUE(found && found->meeting == Meeting::pinch);
      for (const Index e : found->edges) {
        EXPECT_THAT(walk.edges[static_cast<std::size_t>(e)], Contains(found->node));
      }
    } else {
      ++clear;
      EXPECT_FALSE(found) << *found;
    }
  }
  EXPECT_GT(met, 10000);
  EXPECT_GT(entangled, 100);
  EXPECT_GT(clear, 1000);
}

TEST(OutlineCrossing, ALongPolygonIsFoundWholeOrNot) {
  // A star of many nodes around the origin crosses itself nowhere; with two nodes exchanged it does
  // or does not, as brute force tells.
  evolve::RandomStream random(evolve::Purpose::test, 42, 0, 0);
  int met = 0;
  for (int i = 0; i < 300; ++i) {
    Walk star;
    const int nodes = 80;
    for (int n = 0; n < nodes; ++n) {
      const double angle = 2 * std::numbers::pi * n / nodes, radius = 1e6 * (1 + random.uniform());
      star.at.push_back(
          {std::llround(radius * std::cos(angle)), std::llround(radius * std::sin(angle))});
    }
    star.edges = closed(star.at.size());
    const auto [x, y] = coordinates(star, 1e-6);
    ASSERT_FALSE(first_crossing(x, y, star.edges));
    ASSERT_FALSE(first_overlap(x, y, star.edges));
    std::swap(star.at[random.below(nodes)], star.at[random.below(nodes)]);
    const auto [sx, sy] = coordinates(star, 1);
    const auto found = first_crossing(sx, sy, star.edges);
    const auto expected = lowest_pair(star);
    met += expected ? 1 : 0;
    ASSERT_EQ(found.has_value(), expected.has_value());
    if (found) {
      EXPECT_EQ(found->edges, *expected);
    }
  }
  EXPECT_GT(met, 200);
}

TEST(OutlineCrossing, OverlapAgreesWithWindingNumbers) {
  evolve::RandomStream random(evolve::Purpose::test, 43, 0, 0);
  int overlapping = 0, apart = 0;
  for (int i = 0; i < 60000; ++i) {
    Walk loops;
    const std::uint32_t count = 1 + random.below(4);
    bool flat = false;
    for (std::uint32_t l = 0; l < count; ++l) {
      const auto first = static_cast<Index>(loops.at.size());
      const std::uint32_t grid = 4u << random.below(3);
      for (Index n = 0; n < 3; ++n) {
        loops.at.push_back(random_point(random, grid));
        loops.edges.push_back({first + n, first + (n + 1) % 3});
      }
      const std::size_t a = loops.at.size() - 3;
      const std::int64_t area = cross(loops.at[a + 1] - loops.at[a], loops.at[a + 2] - loops.at[a]);
      flat = flat || area == 0;
      if (area < 0 && random.chance(0.5)) std::swap(loops.at[a], loops.at[a + 1]);
    }
    if (flat || lowest_pair(loops)) continue;
    const auto [x, y] = coordinates(loops, 1);
    const auto found = first_overlap(x, y, loops.edges);
    const bool expected =
        std::any_of(loops.edges.begin(), loops.edges.end(),
                    [&](const auto& edge) { return winding_on_the_right(loops, edge) != 0; });
    ASSERT_EQ(found.has_value(), expected);
    ++(expected ? overlapping : apart);
    if (found) {
      EXPECT_NE(winding_on_the_right(loops, loops.edges[static_cast<std::size_t>(*found)]), 0);
    }
  }
  EXPECT_GT(overlapping, 1000);
  EXPECT_GT(apart, 1000);
}

}  // namespace
}  // namespace metamorph::core
