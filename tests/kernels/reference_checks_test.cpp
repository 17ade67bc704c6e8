#include "kernels/reference/checks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "tests/kernels/points.h"

namespace metamorph::tests {
namespace {

/// Two triangles on a unit square, corners counter-clockwise from the origin.
struct Square {
  Square() : points(4) {
    points.x = {0, 1, 1, 0};
    points.y = {0, 0, 1, 1};
  }
  ref::Health examine(double h = 0.1) const {
    return ref::examine({triangles, rest, 0.15}, points.nodes(), h, {});
  }
  Points points;
  std::vector<ref::Triangle> triangles = {{0, 1, 2}, {0, 2, 3}};
  std::vector<double> rest = {0.5, 0.5};
};

TEST(Checks, ASoundStateHasNoFault) {
  Square square;
  square.points.vx[1] = -2;
  const ref::Health health = square.examine();
  EXPECT_EQ(health.fault, ref::Fault::none);
  EXPECT_EQ(health.min_area_ratio, 1);
  EXPECT_EQ(health.max_speed, 2);
}

TEST(Checks, NamesTheInvertedTriangle) {
  Square square;
  square.points.x[3] = 1.5;
  const ref::Health health = square.examine();
  EXPECT_EQ(health.fault, ref::Fault::inverted);
  EXPECT_EQ(health.index, 1);
  EXPECT_EQ(health.value, -0.5);
}

TEST(Checks, NamesTheCollapsedTriangle) {
  Square square;
  square.points.x[3] = 1 - 0.03125;
  const ref::Health health = square.examine();
  EXPECT_EQ(health.fault, ref::Fault::collapsed);
  EXPECT_EQ(health.index, 1);
  EXPECT_EQ(health.value, 0.03125);
  square.points.x[3] = 1 - 0.0625;
  EXPECT_EQ(square.examine().fault, ref::Fault::none);
}

TEST(Checks, ATriangleTooSmallForPressureMayInvert) {
  Square square;
  square.points.x[3] = 1.5;
  square.rest[1] = 0.149;
  EXPECT_EQ(square.examine().fault, ref::Fault::none);
}

TEST(Checks, NamesTheFastestNode) {
  Square square;
  square.points.vx[1] = 4.5;
  square.points.vy[2] = -5;
  ref::Health health = square.examine();
  EXPECT_EQ(health.fault, ref::Fault::speed);
  EXPECT_EQ(health.index, 2);
  EXPECT_EQ(health.value, 5);
  square.points.vx[1] = 0;
  square.points.vy[2] = -3.5;
  EXPECT_EQ(square.examine(0.2).fault, ref::Fault::none);
  EXPECT_EQ(square.examine(0.25).fault, ref::Fault::speed);  // 0.875 d in one step
}

TEST(Checks, NamesTheNodeThatIsNotFinite) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()})
    for (int which = 0; which < 4; ++which) {
      Square square;
      Points& p = square.points;
      std::vector<double>* const arrays[] = {&p.x, &p.y, &p.vx, &p.vy};
      (*arrays[which])[2] = bad;
      const ref::Health health = square.examine();
      EXPECT_EQ(health.fault, ref::Fault::non_finite);
      EXPECT_EQ(health.index, 2);
      EXPECT_FALSE(std::isfinite(health.value));
    }
}

}  // namespace
}  // namespace metamorph::tests
