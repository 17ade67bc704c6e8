// What a body at rest says of its form: shapes whose numbers are known, invariances, brute force.

#include "metamorph/shape.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/body/area.h"
#include "core/body/limbs.h"
#include "tests/bodies.h"

namespace metamorph::core {
namespace {

using std::numbers::pi;
using Points = std::set<tests::LatticePoint>;

constexpr double rounding = 1e-12;  ///< of sums of some hundred terms of the size of the result

/// Unit squares, each of two triangles, given by their lower left corners.
Body squares_body(const std::set<std::pair<int, int>>& squares) {
  Body body;
  std::map<std::pair<int, int>, Index> nodes;
  const auto node = [&](int x, int y) {
    const auto [at, is_new] = nodes.try_emplace({x, y}, body.node_count());
    if (is_new) {
      body.x.push_back(x);
      body.y.push_back(y);
    }
    return at->second;
  };
  for (const auto& [x, y] : squares) {
    const Index a = node(x, y), b = node(x + 1, y), c = node(x + 1, y + 1), d = node(x, y + 1);
    body.triangles.push_back({a, b, c});
    body.triangles.push_back({a, c, d});
  }
  set_rest_from_nodes(body);
  tests::set_wave(body);
  return body;
}

Body rectangle(int width, int height) {
  std::set<std::pair<int, int>> squares;
  for (int x = 0; x < width; ++x) {
    for (int y = 0; y < height; ++y) squares.insert({x, y});
  }
  return squares_body(squares);
}

/// Arms of unit squares from the origin, of these lengths: right, up, left, down.
std::set<std::pair<int, int>> arms(int right, int up, int left, int down) {
  std::set<std::pair<int, int>> squares;
  for (int i = -left; i <= right; ++i) squares.insert({i, 0});
  for (int i = -down; i <= up; ++i) squares.insert({0, i});
  return squares;
}

/// Turned by an angle, mirrored if told so, scaled, shifted.
Body moved(Body body, double angle, double scale, double dx, double dy, bool mirrored) {
  const double c = scale * std::cos(angle), s = scale * std::sin(angle);
  for (std::size_t i = 0; i < body.x.size(); ++i) {
    const double x = body.x[i], y = mirrored ? -body.y[i] : body.y[i];
    body.x[i] = c * x - s * y + dx;
    body.y[i] = s * x + c * y + dy;
  }
  for (auto& triangle : body.triangles) {
    if (mirrored) std::swap(triangle[1], triangle[2]);
  }
  set_rest_from_nodes(body);
  return body;
}

Body moved_anyhow(const Body& body, double scale) {
  const auto up_to = [](int most) { return *rc::gen::inRange(-1000 * most, 1000 * most) / 1000.0; };
  return moved(body, up_to(3), scale, up_to(50), up_to(50), *rc::gen::arbitrary<bool>());
}

TEST(Shape, OfASquare) {
  const Shape shape = shape_of(rectangle(3, 3));
  EXPECT_NEAR(shape.elongation, 0, rounding);
  EXPECT_NEAR(shape.compactness, pi / 4, rounding);
  EXPECT_EQ(shape.symmetry, 1);
  EXPECT_EQ(shape.limbs, 0);
}

TEST(Shape, OfARectangle) {
  const Shape shape = shape_of(rectangle(4, 1));
  EXPECT_NEAR(shape.elongation, 1 - 1.0 / 4, rounding);
  EXPECT_NEAR(shape.compactness, 4 * pi * 4 / (10 * 10), rounding);
  EXPECT_EQ(shape.symmetry, 1);
  EXPECT_EQ(shape.limbs, 2);  // its ends
}

TEST(Shape, OfAPlus) {
  const Body body = squares_body(arms(3, 3, 3, 3));
  const Shape shape = shape_of(body);
  EXPECT_NEAR(shape.elongation, 0, rounding);
  EXPECT_NEAR(shape.compactness, 4 * pi * 13 / (28 * 28), rounding);
  EXPECT_EQ(shape.symmetry, 1);
  EXPECT_EQ(shape.limbs, 4);
}

TEST(Shape, OfAnL) {
  const auto squares = arms(4, 4, 0, 0);
  const Body body = squares_body(squares);
  const Shape shape = shape_of(body);
  // Moments of unit squares, each 1/12 about its own centre.
  double x = 0, xx = 0, xy = 0;
  for (const auto& square : squares) x += square.first / 9.0;
  for (const auto& [u, v] : squares) {
    xx += 1.0 / 12 + (u - x) * (u - x);
    xy += (u - x) * (v - x);
  }
  // x and y are exchangeable: the axes are the diagonals.
  const double along = xx + std::abs(xy), across = xx - std::abs(xy);
  EXPECT_NEAR(shape.elongation, 1 - std::sqrt(across / along), rounding);
  EXPECT_NEAR(shape.compactness, 4 * pi * 9 / (20 * 20), rounding);
  EXPECT_EQ(shape.symmetry, 1);  // of all axes only the diagonal through the corner
  // The corner rises from 1.61 to 2.28, by 0.39 of the disc's radius: too blunt to be a third.
  EXPECT_EQ(shape.limbs, 2);
}

TEST(Shape, OfAHexagonAndDiscs) {
  EXPECT_NEAR(shape_of(tests::hexagon_body()).compactness, pi / std::sqrt(12), rounding);
  for (const int nodes : {7, 19, 37, 91, 253}) {
    const Shape shape = shape_of(tests::disc_body(nodes));
    EXPECT_NEAR(shape.elongation, 0, rounding) << nodes;
    EXPECT_EQ(shape.symmetry, 1) << nodes;
    EXPECT_EQ(shape.limbs, 0) << nodes;
    // Along lattice lines a way is at most 2/sqrt(3) times as long as straight.
    EXPECT_GT(shape.compactness, 0.75) << nodes;
    EXPECT_LT(shape.compactness, pi / std::sqrt(12) + rounding) << nodes;
  }
}

TEST(Shape, AHoleHasAnOutlineToo) {
  const Body ring = tests::ring_body(4, 7);
  const auto outline = outline_of(ring.triangles);
  const std::vector<Index> outside = around_outside(ring, outline);
  EXPECT_LT(outside.size(), outline.size());
  double nearest = 100;
  for (const Index node : outside) {
    const auto n = static_cast<std::size_t>(node);
    nearest = std::min(nearest, std::hypot(ring.x[n], ring.y[n]));
  }
  EXPECT_GT(nearest, 5.5);
  const Shape shape = shape_of(ring);
  const double area = area_of(ring).size;
  EXPECT_NEAR(shape.compactness,
              4 * pi * area / (static_cast<double>(outline.size() * outline.size())), rounding);
  EXPECT_EQ(shape.limbs, 0);
  EXPECT_EQ(shape.symmetry, 1);
  EXPECT_EQ(shape_of(tests::pinched_body()).limbs, 0);
}

// Around (-1, 1) of the lattice: 19 points without their middle and one corner. The hole comes to
// the outside in one node.
Points holed() {
  Points points;
  for (int u = -2; u <= 2; ++u) {
    for (int v = -2; v <= 2; ++v) {
      const int square = tests::lattice_square({u, v});
      if (square <= 4 && square > 0) points.insert({u, v});
    }
  }
  points.erase({2, -2});
  return points;
}

TEST(AroundOutside, LeavesOutAHoleThatTouchesTheOutside) {
  const Body body = tests::lattice_body(holed());
  const auto outline = outline_of(body.triangles);
  ASSERT_EQ(outline.size(), 18u);
  const std::vector<Index> outside = around_outside(body, outline);
  EXPECT_EQ(outside.size(), 12u);
  EXPECT_EQ(std::set<Index>(outside.begin(), outside.end()).size(), 12u);
}

TEST(AroundOutside, ComesTwiceToAPinchBetweenTwoParts) {
  Points points = holed();
  for (const tests::LatticePoint& p : {tests::LatticePoint{-1, 1}, {-2, 2}, {-2, 1}, {-1, 2}}) {
    points.erase(p);
  }
  for (int turn = 0; turn < 6; ++turn) {  // so that it starts at other nodes, too
    const Body body = moved(tests::lattice_body(points), turn * pi / 3, 1, 0, 0, false);
    const auto outline = outline_of(body.triangles);
    const std::vector<Index> outside = around_outside(body, outline);
    EXPECT_EQ(outside.size(), outline.size());
    EXPECT_EQ(std::set<Index>(outside.begin(), outside.end()).size(), outline.size() - 1);
  }
}

TEST(Shape, StarsHaveAsManyLimbsAsArms) {
  EXPECT_EQ(shape_of(tests::disc_body(13)).limbs, 6);  // a hexagram
  // Arms along lattice directions, two lattice rows wide.
  for (const int count : {2, 3, 6}) {
    Points points;
    for (const tests::LatticePoint& p : tests::lattice_neighbours({0, 0})) points.insert(p);
    points.insert({0, 0});
    const auto directions = tests::lattice_neighbours({0, 0});
    for (std::size_t k = 0; k < 6; k += static_cast<std::size_t>(6 / count)) {
      const auto [u, v] = directions[k];
      const auto [su, sv] = directions[(k + 1) % 6];
      const auto [tu, tv] = directions[(k + 5) % 6];
      for (int i = 1; i <= 9; ++i) {
        points.insert({i * u, i * v});
        points.insert({i * u + su, i * v + sv});
        points.insert({i * u + tu, i * v + tv});
      }
    }
    const Shape shape = shape_of(tests::lattice_body(points));
    EXPECT_EQ(shape.limbs, count);
    EXPECT_EQ(shape.symmetry, 1) << count;
  }
}

TEST(Shape, OscillatorsByThemselves) {
  Body body = tests::disc_body(19);
  body.period.assign(19, 40);
  body.period[3] = 59;
  EXPECT_NEAR(shape_of(body).mean_period, 41, rounding);

  body.phase.assign(19, 1.25);
  EXPECT_NEAR(shape_of(body).phase_coherence, 1, rounding);
  for (std::size_t i = 0; i < 19; ++i) body.phase[i] = static_cast<double>(i) * 2 * pi / 19 - pi;
  EXPECT_NEAR(shape_of(body).phase_coherence, 0, rounding);
  // Two groups, and whole turns that say nothing: (9 + 10 exp(i)) / 19.
  for (std::size_t i = 0; i < 19; ++i) body.phase[i] = i < 9 ? 2 * pi : 1 - 4 * pi;
  EXPECT_NEAR(shape_of(body).phase_coherence, std::sqrt(81 + 100 + 180 * std::cos(1)) / 19,
              rounding);
}

// The body is the same wherever it lies; what is a ratio is the same at any size.
RC_GTEST_PROP(Shape, DoesNotDependOnPlaceAndTurn, ()) {
  const Body body = tests::blob_body(*rc::gen::inRange(8, 120), *rc::gen::inRange<unsigned>(0, 99));
  const Shape here = shape_of(body);
  const Shape there = shape_of(moved_anyhow(body, 1));
  RC_ASSERT(std::abs(there.elongation - here.elongation) < 1e-10);
  RC_ASSERT(std::abs(there.compactness - here.compactness) < 1e-10);
  RC_ASSERT(there.symmetry == here.symmetry);
  RC_ASSERT(there.limbs == here.limbs);
  RC_ASSERT(there.mean_period == here.mean_period);
  RC_ASSERT(there.phase_coherence == here.phase_coherence);
  const Shape larger = shape_of(moved_anyhow(body, *rc::gen::inRange(30, 300) / 100.0));
  RC_ASSERT(std::abs(larger.elongation - here.elongation) < 1e-10);
  RC_ASSERT(std::abs(larger.compactness - here.compactness) < 1e-10);
  RC_ASSERT(larger.limbs == here.limbs);
}

/// The lattice points of a body without jitter.
Points points_of(const Body& body) {
  Points points;
  for (std::size_t i = 0; i < body.x.size(); ++i) {
    const int v = static_cast<int>(std::lround(body.y[i] / (0.5 * std::numbers::sqrt3)));
    points.insert({static_cast<int>(std::lround(body.x[i] - 0.5 * v)), v});
  }
  return points;
}

RC_GTEST_PROP(Symmetry, OfASymmetricBodyIsOne, ()) {
  Points points = points_of(
      tests::blob_body(*rc::gen::inRange(8, 100), *rc::gen::inRange<unsigned>(0, 999), 0));
  for (const auto& [u, v] : Points(points)) points.insert({u + v, -v});  // y to -y
  const Body body = moved_anyhow(tests::lattice_body(points), 1);
  RC_ASSERT(shape_of(body).symmetry == 1);
}

/// The share by one axis, each node compared with each.
double share_by(const Body& body, double angle) {
  const double n = static_cast<double>(body.x.size());
  double mean_x = 0, mean_y = 0;
  for (std::size_t i = 0; i < body.x.size(); ++i) {
    mean_x += body.x[i] / n;
    mean_y += body.y[i] / n;
  }
  int partners = 0;
  for (std::size_t i = 0; i < body.x.size(); ++i) {
    const double x = body.x[i] - mean_x, y = body.y[i] - mean_y;
    const double mx = mean_x + std::cos(2 * angle) * x + std::sin(2 * angle) * y;
    const double my = mean_y + std::sin(2 * angle) * x - std::cos(2 * angle) * y;
    bool found = false;
    for (std::size_t j = 0; j < body.x.size(); ++j) {
      found = found || std::hypot(body.x[j] - mx, body.y[j] - my) <= 0.5;
    }
    partners += found;
  }
  return partners / n;
}

TEST(Symmetry, IsNoMoreThanTheBestAxisHas) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const Body body = tests::blob_body(30, seed);
    double best = 0, worst = 1;
    for (int a = 0; a < 3600; ++a) {
      const double share = share_by(body, a * pi / 3600);
      best = std::max(best, share);
      worst = std::min(worst, share);
    }
    const double found = shape_of(body).symmetry;
    EXPECT_LE(found, best + 0.5 / 30);  // another axis may lie between these
    EXPECT_GE(found, 0.5 * (best + worst));
    EXPECT_LT(found, 1);
  }
}

TEST(Symmetry, OfAHookIsLow) {
  // A long bar with a foot at one end, on one side.
  const double hook = shape_of(squares_body(arms(5, 12, 0, 0))).symmetry;
  EXPECT_LT(hook, 0.75);
  EXPECT_GT(hook, 0.2);
}

TEST(Overlap, OfABodyWithItselfIsOneWhereverItLies) {
  for (const Body& body : {tests::ring_body(3, 6), tests::pinched_body(), tests::jaws_body(),
                           tests::blob_body(60, 1), tests::lattice_body(holed())}) {
    EXPECT_EQ(overlap(body, body), 1);
    EXPECT_NEAR(overlap(body, moved(body, 0, 1, 17.3, -8.1, false)), 1, 1e-10);
  }
}

TEST(Overlap, OfKnownShapes) {
  EXPECT_NEAR(overlap(rectangle(4, 1), rectangle(1, 4)), 1.0 / 7, rounding);
  EXPECT_NEAR(overlap(rectangle(4, 4), rectangle(2, 2)), 4.0 / 16, rounding);
  EXPECT_NEAR(overlap(rectangle(5, 1), squares_body(arms(2, 2, 2, 2))), 5.0 / 9, rounding);
  EXPECT_NEAR(overlap(rectangle(5, 5), squares_body(arms(2, 2, 2, 2))), 9.0 / 25, rounding);
}

TEST(Overlap, OfARingAndWhatFitsIntoItsHoleIsNone) {
  EXPECT_EQ(overlap(tests::ring_body(5, 8), tests::disc_body(31)), 0);
  EXPECT_EQ(overlap(tests::disc_body(31), tests::ring_body(5, 8)), 0);
}

bool covers(const Body& body, double x, double y) {
  return std::any_of(body.triangles.begin(), body.triangles.end(), [&](const auto& triangle) {
    for (std::size_t side = 0; side < 3; ++side) {
      const auto a = static_cast<std::size_t>(triangle[side]);
      const auto b = static_cast<std::size_t>(triangle[(side + 1) % 3]);
      if ((body.x[b] - body.x[a]) * (y - body.y[a]) - (body.y[b] - body.y[a]) * (x - body.x[a]) < 0)
        return false;
    }
    return true;
  });
}

// Points of a grid that lie in one, or in both.
TEST(Overlap, IsTheShareOfPoints) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const Body a = tests::blob_body(30, seed), b = tests::blob_body(45, seed + 100);
    const auto ca = area_of(a).centroid, cb = area_of(b).centroid;
    constexpr double spacing = 0.1;
    int both = 0, either = 0;
    for (double x = -12; x < 12; x += spacing) {
      for (double y = -12; y < 12; y += spacing) {
        const bool in_a = covers(a, ca[0] + x, ca[1] + y), in_b = covers(b, cb[0] + x, cb[1] + y);
        both += in_a && in_b;
        either += in_a || in_b;
      }
    }
    const double share = overlap(a, b);
    EXPECT_GT(share, 0.3);
    EXPECT_NEAR(share, static_cast<double>(both) / either, 0.02);
    EXPECT_NEAR(share, overlap(b, a), rounding);
  }
}

}  // namespace
}  // namespace metamorph::core
