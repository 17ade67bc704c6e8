#include "core/development/triangulation_repair.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "core/development/delaunay.h"
#include "metamorph/random.h"

namespace metamorph::core {
namespace {

/// Points that wander, die and are born, with the bookkeeping of an update.
struct Swarm {
  std::vector<double> x, y;
  std::vector<Index> previous;
  evolve::RandomStream random;

  explicit Swarm(std::uint64_t seed) : random(evolve::Purpose::test, seed, 0, 0) {}

  double number(double range) { return range * (2 * random.uniform() - 1); }

  void add(double new_x, double new_y) {
    x.push_back(new_x);
    y.push_back(new_y);
    previous.push_back(-1);
  }

  void remove(std::size_t i) {
    const auto at = static_cast<std::ptrdiff_t>(i);
    x.erase(x.begin() + at);
    y.erase(y.begin() + at);
    previous.erase(previous.begin() + at);
  }

  /// On a grid, where cocircular, collinear and coincident points abound, or like floats.
  void round_to(double grid) {
    for (auto* values : {&x, &y}) {
      for (double& value : *values) {
        value = grid > 0 ? grid * std::round(value / grid)
                         : static_cast<double>(static_cast<float>(value));
      }
    }
  }
};

/// Updates and compares with a triangulation from nothing.
bool follows(TriangulationRepair& repair, Swarm& swarm) {
  repair.update(swarm.x, swarm.y, swarm.previous);
  std::iota(swarm.previous.begin(), swarm.previous.end(), 0);
  Triangulation expected;
  triangulate(swarm.x, swarm.y, expected);
  return repair.edges() == expected.edges && repair.faces() == expected.faces;
}

RC_GTEST_PROP(TriangulationRepair, GivesWhatATriangulationFromNothingGives, ()) {
  Swarm swarm(*rc::gen::inRange<std::uint64_t>(0, 1u << 30));
  const int count = *rc::gen::inRange(1, 60);
  const double pace = *rc::gen::element(0.0, 0.01, 0.1, 0.5);
  const double grid = *rc::gen::element(0.0, 0.0, 0.25, 0.5);
  const double size = *rc::gen::element(2.0, 8.0);
  for (int i = 0; i < count; ++i) swarm.add(swarm.number(size), swarm.number(size));
  TriangulationRepair repair;
  for (int round = 0; round < 12; ++round) {
    swarm.round_to(grid);
    RC_ASSERT(follows(repair, swarm));
    for (std::size_t i = 0; i < swarm.x.size(); ++i) {
      swarm.x[i] += swarm.number(pace);
      swarm.y[i] += swarm.number(pace);
    }
    if (swarm.random.chance(0.5)) {
      for (std::size_t i = swarm.x.size(); i-- > 0;) {
        if (swarm.random.chance(0.1)) swarm.remove(i);
      }
    }
    if (swarm.random.chance(0.5)) {
      for (int births = 0; births < 5; ++births) swarm.add(swarm.number(size), swarm.number(size));
    }
  }
}

TEST(TriangulationRepair, FollowsSmallMotionsWithoutBuildingAnew) {
  Swarm swarm(3);
  for (int i = 0; i < 200; ++i) swarm.add(swarm.number(7), swarm.number(7));
  swarm.round_to(0);
  TriangulationRepair repair;
  ASSERT_TRUE(follows(repair, swarm));
  EXPECT_EQ(repair.rebuilds(), 1);
  int changes = 0;
  for (int round = 0; round < 200; ++round) {
    for (std::size_t i = 0; i < swarm.x.size(); ++i) {
      swarm.x[i] += swarm.number(0.003);
      swarm.y[i] += swarm.number(0.003);
    }
    swarm.round_to(0);
    ASSERT_TRUE(follows(repair, swarm));
    changes += repair.changed();
  }
  EXPECT_GT(changes, 50);
  EXPECT_LT(repair.rebuilds(), 20);
}

TEST(TriangulationRepair, BirthsAndDeathsInsideAndOnTheHullAreRepairs) {
  Swarm swarm(4);
  for (int i = 0; i < 100; ++i) swarm.add(swarm.number(5), swarm.number(5));
  TriangulationRepair repair;
  ASSERT_TRUE(follows(repair, swarm));
  for (int round = 0; round < 200; ++round) {
    swarm.remove(swarm.random.below(static_cast<std::uint32_t>(swarm.x.size())));
    swarm.add(swarm.number(5), swarm.number(5));
    ASSERT_TRUE(follows(repair, swarm));
  }
  EXPECT_EQ(repair.rebuilds(), 1);
}

// Taking 2 and 3 away leaves three points on a line: flipped off the hull, they would be there
// twice.
TEST(TriangulationRepair, WhatIsLeftOnAStraightLineIsBuiltAnew) {
  for (const double bend : {0.0, 1e-9, -1e-9}) {
    Swarm swarm(7);
    for (const auto& [x, y] : {std::pair{0., 0.}, {1., bend}, {1.5, 2.}, {0.5, -2.}, {2., 0.}}) {
      swarm.add(x, y);
    }
    TriangulationRepair repair;
    ASSERT_TRUE(follows(repair, swarm));
    swarm.remove(2);
    EXPECT_TRUE(follows(repair, swarm));
    swarm.remove(2);
    EXPECT_TRUE(follows(repair, swarm));
    swarm.add(1, 1);
    EXPECT_TRUE(follows(repair, swarm));
  }
}

TEST(TriangulationRepair, WithoutMotionNothingChanges) {
  Swarm swarm(5);
  for (int i = 0; i < 50; ++i) swarm.add(swarm.number(4), swarm.number(4));
  TriangulationRepair repair;
  ASSERT_TRUE(follows(repair, swarm));
  EXPECT_TRUE(repair.changed());
  ASSERT_TRUE(follows(repair, swarm));
  EXPECT_FALSE(repair.changed());
}

TEST(TriangulationRepair, APointThatLeavesOrEntersTheHullFlipsItsWay) {
  for (const double end : {-0.5, -0.01, 0.01, 0.5}) {
    Swarm swarm(6);
    for (const auto& [x, y] : {std::pair{0., 0.}, {4., 0.}, {4.5, 3.}, {1., 4.}}) swarm.add(x, y);
    swarm.add(2, 0.2);
    TriangulationRepair repair;
    ASSERT_TRUE(follows(repair, swarm));
    swarm.y[4] = end;
    EXPECT_TRUE(follows(repair, swarm)) << end;
    swarm.y[4] = -end;
    EXPECT_TRUE(follows(repair, swarm)) << end;
    EXPECT_EQ(repair.rebuilds(), 1) << end;
  }
}

TEST(Predicates, AgreeWithTheExactOnesNearTheirZeros) {
  evolve::RandomStream random(evolve::Purpose::test, 9, 0, 0);
  const auto nearly = [&](double value) {
    // Within a few units in the last place: most filters fail, many signs are 0.
    return value + (static_cast<double>(random.below(5)) - 2) * 0x1p-50;
  };
  for (int i = 0; i < 20000; ++i) {
    const Point a = {nearly(1), nearly(0)}, b = {nearly(0), nearly(1)}, c = {nearly(-1), nearly(0)};
    const Point d = {nearly(0), nearly(-1)};
    ASSERT_EQ(in_circle(a, b, c, d), exact_in_circle(a, b, c, d));
    ASSERT_NE(in_circle(a, b, c, d), 0);
    ASSERT_EQ(in_circle(a, b, c, d), in_circle(b, c, a, d));
    // Seen from the other face of the edge c-a, the answer is the same.
    ASSERT_EQ(in_circle(a, b, c, d), in_circle(c, d, a, b));
    const Point e = {nearly(0.5), nearly(0.5)};
    ASSERT_EQ(orientation(a, e, b), exact_orientation(a, e, b));
    ASSERT_EQ(orientation(a, e, b), -orientation(b, e, a));
  }
}

}  // namespace
}  // namespace metamorph::core
