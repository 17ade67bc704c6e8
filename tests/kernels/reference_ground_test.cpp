#include "kernels/reference/ground.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/random.h"
#include "kernels/reference/gravity.h"
#include "kernels/reference/spring.h"
#include "tests/kernels/points.h"
#include "tests/tolerance.h"

namespace metamorph::tests {
namespace {

constexpr double g = 0.02, k_n = 4, c_n = 0.8, h = 0.1;

/// A block of one node, resting on ground that rises by `degrees` at the depth that carries it.
struct Block {
  explicit Block(double degrees) : angle(degrees * std::numbers::pi / 180), point(1) {
    point.y[0] = -g * std::cos(angle) / k_n;
  }
  void slide(double mu, double duration) {
    integrate(
        point, drift_kick_drift, duration, h,
        [this](const ref::Nodes& nodes, double, const ref::Forces& sums, std::span<double> normal) {
          ref::add_weight({-g * std::sin(angle), -g * std::cos(angle)}, 1.0, sums);
          ref::add_ground_forces(k_n, c_n, nodes, normal, sums);
        },
        1.0, mu);
  }
  double angle;
  Points point;
};

TEST(Ground, SlopeOf17DegreesHoldsABlockIfFrictionExceedsItsTangent) {
  // Sticks iff mu > tan 17 degrees = 0.3057; else slides down with a = g (sin - mu cos).
  for (const double mu : {0.0, 0.2, 0.30, 0.31, 0.8}) {
    Block block(17);
    block.slide(mu, 400);
    if (mu > std::tan(block.angle)) {
      EXPECT_EQ(block.point.vx[0], 0) << "mu " << mu;
      EXPECT_EQ(block.point.x[0], 0) << "mu " << mu;
    } else {
      const double a = g * (std::sin(block.angle) - mu * std::cos(block.angle));
      // Every step rounds alike.
      EXPECT_TRUE(within(block.point.vx[0] / (a * 400) + 1,
                         tolerance::growth(round_off_64, g / a, 400 / h)))
          << "mu " << mu;
      EXPECT_TRUE(within(block.point.x[0] / (a * 400 * 400 / 2) + 1,
                         tolerance::growth(round_off_64, g / a, 400 / h)))
          << "mu " << mu;
    }
  }
}

TEST(Ground, ABlockStopsAfterTheDistanceOfItsEnergy) {
  // v0^2/(2 mu g). Deceleration is constant; the last step stops within h of the true moment, at a
  // speed below mu g h: an error of at most mu g h^2.
  for (const double v0 : {0.1, 0.3, 0.71})
    for (const double mu : {0.2, 0.8}) {
      Block block(0);
      block.point.vx[0] = v0;
      block.slide(mu, 400);
      EXPECT_EQ(block.point.vx[0], 0);
      EXPECT_TRUE(within(block.point.x[0] - v0 * v0 / (2 * mu * g), mu * g * h * h))
          << "v0 " << v0 << " mu " << mu;
    }
}

TEST(Ground, FrictionHoldsAStretchedPairUpToItsLimit) {
  // Two blocks on a damped spring stay where they are as long as k x <= mu m g; else they slide at
  // least to there. An integrator that took their kicks for motion would let the damper help to
  // hold them, by c h = 4 % here.
  constexpr double k = 1, c = 0.4, mu = 0.8;
  const std::vector<ref::Edge> spring = {{0, 1}};
  const std::vector<double> length = {1};
  for (const double load : {0.99, 1.01}) {
    const double stretch = load * mu * g / k;
    Points pair(2);
    pair.x[1] = length[0] + stretch;
    pair.y = {-g / k_n, -g / k_n};
    integrate(
        pair, drift_kick_drift, 20, h,
        [&](const ref::Nodes& nodes, double, const ref::Forces& sums, std::span<double> normal) {
          ref::add_spring_forces(spring, length, k, c, nodes, sums);
          ref::add_weight({0, -g}, 1.0, sums);
          ref::add_ground_forces(k_n, c_n, nodes, normal, sums);
        },
        1.0, mu);
    if (load < 1) {
      EXPECT_EQ(pair.x[1] - pair.x[0], length[0] + stretch);
    } else {
      EXPECT_LT(pair.x[1] - pair.x[0], length[0] + mu * g / k);
    }
  }
}

TEST(Ground, PressesOnlyBelowZeroAndNeverPulls) {
  Points points(5);
  points.y = {0.1, 0.0, -0.25, -0.25, -0.25};
  points.vy = {-1, -1, 0, -0.5, 4};
  std::vector<double> fx(5), fy(5), normal(5);
  ref::add_ground_forces(k_n, c_n, points.nodes(), normal, {fx, fy});
  EXPECT_EQ(normal, (std::vector<double>{0, 0, 1, 1 + c_n * 0.5, 0}));
  EXPECT_EQ(fy, normal);
  EXPECT_EQ(fx, (std::vector<double>(5)));
}

TEST(Ground, ADroppedBlockComesToRestWhereTheGroundCarriesIt) {
  // The contact oscillates at sqrt(k_n) = 2 with damping rate c_n/2 = 0.4: gone after 400.
  Block block(0);
  block.point.y[0] = 0.5;
  block.slide(0.8, 400);
  EXPECT_TRUE(within(block.point.y[0] + g / k_n, 8 * round_off_64 * g / k_n));
  EXPECT_TRUE(within(block.point.vy[0], 8 * round_off_64 * g));
}

TEST(Friction, StaysInItsConeAndNeverTurnsTheMotion) {
  core::RandomStream random(core::Purpose::test, 1, 0, 0);
  for (int i = 0; i < 10000; ++i) {
    const double v = 2 * random.triangular();
    const double limit = random.uniform();
    const double after = ref::after_friction(v, limit);
    EXPECT_GE(after * v, 0);
    EXPECT_LE(std::fabs(after), std::fabs(v));
    EXPECT_LE(std::fabs(v - after), limit + round_off_64 * std::fabs(v));
    if (std::fabs(v) <= limit) {
      EXPECT_EQ(after, 0);
    }
  }
  EXPECT_EQ(ref::after_friction(-0.3, 0.0), -0.3);
  EXPECT_TRUE(std::isnan(ref::after_friction(std::nan(""), 0.1)));
}

TEST(Weight, IsMinusTheGradientOfItsEnergy) {
  const ref::Gravity gravity{-0.25, -0.5};
  Points points(1);
  points.x[0] = 3;
  points.y[0] = 2;
  std::vector<double> fx(1), fy(1);
  ref::add_weight(gravity, 2, {fx, fy});
  EXPECT_EQ(fx[0], -0.5);
  EXPECT_EQ(fy[0], -1);
  EXPECT_EQ(ref::weight_energy(gravity, 2, points.nodes()), -(fx[0] * 3 + fy[0] * 2));
}

}  // namespace
}  // namespace metamorph::tests
