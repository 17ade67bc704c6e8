// The quick look whether an outline may cross itself against exact predicates on every two edges.

#include "kernels/edge_crossing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "core/body/aligned.h"
#include "core/body/predicates.h"
#include "metamorph/random.h"

namespace metamorph::tests {
namespace {

using core::Point;

/// Closed polygons; coordinates are floats.
struct Outline {
  std::vector<Point> points;
  std::vector<std::array<std::size_t, 2>> edges;

  void add(const std::vector<Point>& polygon) {
    const std::size_t first = points.size(), n = polygon.size();
    for (std::size_t i = 0; i < n; ++i) {
      points.push_back({static_cast<float>(polygon[i].x), static_cast<float>(polygon[i].y)});
      edges.push_back({first + i, first + (i + 1) % n});
    }
  }
};

template <class T>
bool may_cross(const Outline& outline) {
  const auto width = static_cast<std::size_t>(kernels::Lanes<T>::width);
  const std::size_t n = outline.edges.size(), filled = (n + width - 1) / width * width;
  std::array<core::Aligned<T>, 6> values;
  for (auto& v : values) v.assign(filled, T(0));
  for (std::size_t e = 0; e < n; ++e) {
    const auto [a, b] = outline.edges[e];
    const Point p = outline.points[a], q = outline.points[b];
    std::size_t at = 0;
    for (const double value : {static_cast<double>(a), static_cast<double>(b), p.x, p.y, q.x, q.y})
      values[at++][e] = static_cast<T>(value);
  }
  return kernels::any_may_cross<T>({static_cast<int>(n), values[0].data(), values[1].data(),
                                    values[2].data(), values[3].data(), values[4].data(),
                                    values[5].data()});
}

/// Both ends of an edge strictly on one side of the line through the other.
bool apart(Point a, Point b, Point c, Point d) {
  return core::exact_orientation(a, b, c) * core::exact_orientation(a, b, d) > 0;
}

/// c, which lies on the line through a and b, between them or one of them.
bool between(Point a, Point b, Point c) {
  return std::min(a.x, b.x) <= c.x && c.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= c.y &&
         c.y <= std::max(a.y, b.y);
}

/// Two segments that have a point in common, exactly.
bool meet(Point a, Point b, Point c, Point d) {
  const bool level = core::exact_orientation(a, b, c) == 0 && core::exact_orientation(a, b, d) == 0;
  if (!level) return !apart(a, b, c, d) && !apart(c, d, a, b);
  return between(a, b, c) || between(a, b, d) || between(c, d, a) || between(c, d, b);
}

template <class Edge>
bool joined(const Edge& e, const Edge& f) {
  return e[0] == f[0] || e[0] == f[1] || e[1] == f[0] || e[1] == f[1];
}

/// What test(a, b, c, d) says of any two edges without a common end.
template <class Test>
bool any(const Outline& outline, Test&& test) {
  for (std::size_t e = 0; e < outline.edges.size(); ++e)
    for (std::size_t f = 0; f < e; ++f) {
      if (joined(outline.edges[e], outline.edges[f])) continue;
      const auto point = [&](std::size_t edge, std::size_t end) {
        return outline.points[outline.edges[edge][end]];
      };
      if (test(point(e, 0), point(e, 1), point(f, 0), point(f, 1))) return true;
    }
  return false;
}

bool crosses(const Outline& outline) { return any(outline, meet); }

/// Some two edges are not clearly apart: of all four ends none is on its side of the other edge's
/// line by more than `share` of the lengths.
bool nearly_crosses(const Outline& outline, double share) {
  return any(outline, [=](Point a, Point b, Point c, Point d) {
    const auto clear = [=](Point p, Point q, Point r, Point s) {
      const auto side = [&](Point at) {
        const double ux = q.x - p.x, uy = q.y - p.y, wx = at.x - p.x, wy = at.y - p.y;
        return (ux * wy - uy * wx) / (std::abs(ux * wy) + std::abs(uy * wx) + 1e-30);
      };
      return std::min(side(r), side(s)) > share || std::max(side(r), side(s)) < -share;
    };
    return !clear(a, b, c, d) && !clear(c, d, a, b);
  });
}

/// A star around a place, of n corners between radius 1 - `depth` and 1, each moved along the rim
/// by up to `stray` of the distance of two.
std::vector<Point> star(evolve::RandomStream& random, int n, double depth, double stray, double x,
                        double y) {
  std::vector<Point> points;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * (i + stray * random.triangular()) / n;
    const double radius = 1 - depth * random.uniform();
    points.push_back({x + radius * std::cos(angle), y + radius * std::sin(angle)});
  }
  return points;
}

template <class T>
void compare_with_exact_predicates() {
  evolve::RandomStream random(evolve::Purpose::test, 1, 2, 3);
  // In lanes a product of two differences is rounded three times: 16 round-offs are beyond doubt.
  const double doubt = 32 * static_cast<double>(std::numeric_limits<T>::epsilon());
  int crossed = 0, whole = 0;
  for (int attempt = 0; attempt < 3000; ++attempt) {
    Outline outline;
    const double far = random.uniform() < 0.5 ? 0 : 100 * random.triangular();
    const int n = 3 + static_cast<int>(random.below(40));
    outline.add(star(random, n, 0.6 * random.uniform(), 1.5 * random.uniform(), far, 1));
    if (random.uniform() < 0.3)  // a second one: outside, inside or across
      outline.add(star(random, 3 + static_cast<int>(random.below(20)), 0.2, 0.3,
                       far + 3 * random.triangular(), 1));
    const bool expected = crosses(outline);
    ASSERT_TRUE(!expected || may_cross<T>(outline)) << "attempt " << attempt;
    const bool clear = !nearly_crosses(outline, doubt);
    ASSERT_FALSE(clear && may_cross<T>(outline)) << "attempt " << attempt;
    crossed += expected;
    whole += clear;
  }
  EXPECT_GT(crossed, 300);
  EXPECT_GT(whole, 300);
}

TEST(EdgeCrossing, IsSeenWheneverThereIsOneInFloat) { compare_with_exact_predicates<float>(); }
TEST(EdgeCrossing, IsSeenWheneverThereIsOneInDouble) { compare_with_exact_predicates<double>(); }

TEST(EdgeCrossing, TouchingIsSeen) {
  // Polygons with corners on a coarse grid: corners on edges, edges along each other, corners at
  // one place.
  evolve::RandomStream random(evolve::Purpose::test, 1, 2, 4);
  int touched = 0;
  for (int attempt = 0; attempt < 3000; ++attempt) {
    Outline outline;
    std::vector<Point> points;
    for (int i = 0; i < 4; ++i)
      points.push_back(
          {static_cast<double>(random.below(4)), static_cast<double>(random.below(4))});
    outline.add(points);
    const bool expected = crosses(outline);
    ASSERT_TRUE(!expected || may_cross<float>(outline));
    ASSERT_TRUE(!expected || may_cross<double>(outline));
    touched += expected;
  }
  EXPECT_GT(touched, 300);
  EXPECT_LT(touched, 2700);
}

TEST(EdgeCrossing, EveryPairIsLookedAt) {
  // A comb that is whole but for one tooth, at every place of a pack and across packs.
  for (std::size_t n = 4; n < 40; ++n)
    for (std::size_t tooth = 0; tooth < n; ++tooth) {
      Outline outline;
      evolve::RandomStream random(evolve::Purpose::test, 1, 2, 5);
      std::vector<Point> polygon = star(random, static_cast<int>(n), 0, 0, 0, 0);
      outline.add(polygon);
      ASSERT_FALSE(may_cross<float>(outline));
      ASSERT_FALSE(may_cross<double>(outline));
      // Through the opposite side.
      outline.points[tooth] = {-1.5 * polygon[tooth].x, -1.5 * polygon[tooth].y};
      ASSERT_EQ(may_cross<float>(outline), crosses(outline)) << n << " " << tooth;
      ASSERT_EQ(may_cross<double>(outline), crosses(outline)) << n << " " << tooth;
    }
}

}  // namespace
}  // namespace metamorph::tests
