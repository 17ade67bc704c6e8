#include "core/development/delaunay.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <vector>

namespace metamorph::core {
namespace {

using Integer = __int128;

/// Points with small integer coordinates, where determinants are exact in 128 bits.
struct Points {
  std::vector<double> x, y;
  std::size_t size() const { return x.size(); }
};

Integer coordinate(const std::vector<double>& values, Index i) {
  return static_cast<Integer>(values[static_cast<std::size_t>(i)]);
}

/// Twice the area of abc, positive if counter-clockwise.
Integer area(const Points& p, Index a, Index b, Index c) {
  const Integer ax = coordinate(p.x, a), ay = coordinate(p.y, a);
  return (coordinate(p.x, b) - ax) * (coordinate(p.y, c) - ay) -
         (coordinate(p.y, b) - ay) * (coordinate(p.x, c) - ax);
}

/// Positive if d lies inside the circle through the counter-clockwise a, b, c.
Integer in_circle(const Points& p, Index a, Index b, Index c, Index d) {
  Integer m[3][3];
  const Index row[3] = {a, b, c};
  for (int i = 0; i < 3; ++i) {
    m[i][0] = coordinate(p.x, row[i]) - coordinate(p.x, d);
    m[i][1] = coordinate(p.y, row[i]) - coordinate(p.y, d);
    m[i][2] = m[i][0] * m[i][0] + m[i][1] * m[i][1];
  }
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

Triangulation triangulated(const Points& p) {
  Triangulation result;
  triangulate(p.x, p.y, result);
  return result;
}

std::set<std::array<Index, 2>> edges_of_faces(const Triangulation& t) {
  std::set<std::array<Index, 2>> edges;
  for (const auto& [a, b, c] : t.faces) {
    for (const auto& [i, j] : {std::pair{a, b}, {b, c}, {c, a}}) {
      edges.insert({std::min(i, j), std::max(i, j)});
    }
  }
  return edges;
}

/// Distinct points of a square grid, in random order; on a small grid with many ties.
rc::Gen<Points> distinct_points(int least, int most, int range) {
  return rc::gen::exec([=] {
    const int count = *rc::gen::inRange(least, most + 1);
    const auto pairs = *rc::gen::unique<std::vector<std::pair<int, int>>>(
        static_cast<std::size_t>(count),
        rc::gen::pair(rc::gen::inRange(-range, range + 1), rc::gen::inRange(-range, range + 1)));
    Points points;
    for (const auto& [x, y] : pairs) {
      points.x.push_back(x);
      points.y.push_back(y);
    }
    return points;
  });
}

TEST(Delaunay, FewPoints) {
  EXPECT_TRUE(triangulated({}).edges.empty());
  EXPECT_TRUE(triangulated({{3}, {4}}).edges.empty());
  const Triangulation two = triangulated({{5, 1}, {2, 7}});
  EXPECT_EQ(two.edges, (std::vector<std::array<Index, 2>>{{0, 1}}));
  EXPECT_TRUE(two.faces.empty());
  const Triangulation three = triangulated({{0, 0, 1}, {0, 1, 0}});  // given clockwise
  EXPECT_EQ(three.edges, (std::vector<std::array<Index, 2>>{{0, 1}, {0, 2}, {1, 2}}));
  EXPECT_EQ(three.faces, (std::vector<std::array<Index, 3>>{{0, 2, 1}}));
}

TEST(Delaunay, OnAStraightLineConsecutivePointsShareAnEdge) {
  for (const auto& [dx, dy] : {std::pair{1, 0}, {0, 1}, {2, 3}, {-1, 5}}) {
    Points points;
    for (const int t : {4, -2, 0, 7, 1}) {
      points.x.push_back(t * dx);
      points.y.push_back(t * dy);
    }
    const Triangulation t = triangulated(points);
    EXPECT_EQ(t.edges, (std::vector<std::array<Index, 2>>{{0, 3}, {0, 4}, {1, 2}, {2, 4}}));
    EXPECT_TRUE(t.faces.empty());
  }
}

TEST(Delaunay, OfCoincidentPointsTheLowestTakesPartAndTheOthersHangOnIt) {
  const Triangulation t = triangulated({{0, 4, 0, 4, 0, 4}, {0, 0, 4, 0, 4, 0}});
  EXPECT_EQ(t.faces, (std::vector<std::array<Index, 3>>{{0, 1, 2}}));
  EXPECT_EQ(t.edges,
            (std::vector<std::array<Index, 2>>{{0, 1}, {0, 2}, {1, 2}, {1, 3}, {1, 5}, {2, 4}}));
  EXPECT_EQ(triangulated({{2, 2}, {3, 3}}).edges, (std::vector<std::array<Index, 2>>{{0, 1}}));
}

// Without cocircular points a triple is a face iff no fourth point lies within its circle.
RC_GTEST_PROP(Delaunay, FacesAreTheTriplesWithEmptyCircles, ()) {
  const Points p = *distinct_points(3, 14, 1 << 20);
  const auto n = static_cast<Index>(p.size());
  std::vector<std::array<Index, 3>> faces;
  for (Index a = 0; a < n; ++a) {
    for (Index b = a + 1; b < n; ++b) {
      for (Index c = a + 1; c < n; ++c) {
        if (c == b || area(p, a, b, c) <= 0) continue;
        bool empty = true;
        for (Index d = 0; d < n; ++d) {
          if (d == a || d == b || d == c) continue;
          const Integer inside = in_circle(p, a, b, c, d);
          RC_PRE(inside != 0);
          empty = empty && inside < 0;
        }
        if (empty) faces.push_back({a, b, c});
      }
    }
  }
  std::sort(faces.begin(), faces.end());
  const Triangulation t = triangulated(p);
  RC_ASSERT(t.faces == faces);
  if (!faces.empty()) {
    const auto edges = edges_of_faces(t);
    RC_ASSERT(std::vector(edges.begin(), edges.end()) == t.edges);
  }
}

// With ties the faces are no longer the only ones with empty circles, but still cover the hull.
RC_GTEST_PROP(Delaunay, OnAGridFacesHaveEmptyCirclesAndCoverTheHull, ()) {
  const Points p = *distinct_points(3, 20, 3);
  const auto n = static_cast<Index>(p.size());
  const Triangulation t = triangulated(p);
  RC_PRE(!t.faces.empty());
  Integer covered = 0;
  for (const auto& [a, b, c] : t.faces) {
    RC_ASSERT(area(p, a, b, c) > 0);
    RC_ASSERT((a < b && a < c));
    covered += area(p, a, b, c);
    for (Index d = 0; d < n; ++d) {
      if (d != a && d != b && d != c) RC_ASSERT(in_circle(p, a, b, c, d) <= 0);
    }
  }
  const auto edges = edges_of_faces(t);
  RC_ASSERT(std::vector(edges.begin(), edges.end()) == t.edges);
  // Euler: points - edges + faces = 1, if every point is used.
  RC_ASSERT(n - static_cast<Index>(edges.size()) + static_cast<Index>(t.faces.size()) == 1);
  // Area of the hull by the shoelace over its directed edges: those with nobody on their right.
  Integer hull = 0;
  for (Index a = 0; a < n; ++a) {
    for (Index b = 0; b < n; ++b) {
      if (a == b) continue;
      bool outline = true;
      for (Index c = 0; c < n && outline; ++c) {
        const Integer side = area(p, a, b, c);
        // Of collinear points on a side of the hull only the extreme pair counts.
        const Integer dot =
            (coordinate(p.x, a) - coordinate(p.x, c)) * (coordinate(p.x, b) - coordinate(p.x, c)) +
            (coordinate(p.y, a) - coordinate(p.y, c)) * (coordinate(p.y, b) - coordinate(p.y, c));
        outline = side > 0 || (side == 0 && dot <= 0);
      }
      if (outline) {
        hull += coordinate(p.x, a) * coordinate(p.y, b) - coordinate(p.x, b) * coordinate(p.y, a);
      }
    }
  }
  RC_ASSERT(covered == hull);
}

// Ties included: the triangulation belongs to the points, not to their numbers.
RC_GTEST_PROP(Delaunay, IsIndependentOfTheOrderOfThePoints, ()) {
  const Points p = *distinct_points(1, 30, 4);
  const auto n = p.size();
  std::vector<Index> order(n);
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t i = n; i > 1; --i)
    std::swap(order[i - 1], order[*rc::gen::inRange<std::size_t>(0, i)]);
  Points shuffled;
  for (const Index i : order) {
    shuffled.x.push_back(p.x[static_cast<std::size_t>(i)]);
    shuffled.y.push_back(p.y[static_cast<std::size_t>(i)]);
  }
  const Triangulation expected = triangulated(p);
  std::set<std::array<Index, 2>> edges;
  for (const auto& [i, j] : triangulated(shuffled).edges) {
    const Index a = order[static_cast<std::size_t>(i)], b = order[static_cast<std::size_t>(j)];
    edges.insert({std::min(a, b), std::max(a, b)});
  }
  RC_ASSERT(std::vector(edges.begin(), edges.end()) == expected.edges);
}

}  // namespace
}  // namespace metamorph::core
