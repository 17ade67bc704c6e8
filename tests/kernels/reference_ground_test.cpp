#include "kernels/reference/ground.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "kernels/reference/gravity.h"
#include "kernels/reference/solid.h"
#include "kernels/reference/spring.h"
#include "metamorph/random.h"
#include "tests/kernels/points.h"
#include "tests/tolerance.h"

namespace metamorph::tests {
namespace {

constexpr double g = 0.02, h = 0.1;

/// Ground alone, with friction.
Keep ground(double mu) {
  return [mu](double drift, std::span<const double> x, std::span<const double> y,
              std::span<double> vx, std::span<double> vy, std::span<double> since_vy) {
    ref::keep_apart({.pairs = {}, .least_gap = 0, .ground = true, .friction = mu}, drift, x, y, vx,
                    vy, since_vy);
  };
}

/// A block of one node, resting on ground that rises by `degrees`.
struct Block {
  explicit Block(double degrees) : angle(degrees * std::numbers::pi / 180), point(1) {}
  void slide(double mu, double duration) {
    integrate(
        point, drift_kick_drift, duration, h,
        [this](const ref::Nodes&, double, const ref::Forces& sums) {
          ref::add_weight({-g * std::sin(angle), -g * std::cos(angle)}, 1.0, sums);
        },
        ground(mu));
  }
  double energy() const {
    return (point.vx[0] * point.vx[0] + point.vy[0] * point.vy[0]) / 2 +
           g * (std::sin(angle) * point.x[0] + std::cos(angle) * point.y[0]);
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
    integrate(
        pair, drift_kick_drift, 20, h,
        [&](const ref::Nodes& nodes, double, const ref::Forces& sums) {
          ref::add_spring_forces(spring, length, k, c, nodes, sums);
          ref::add_weight({0, -g}, 1.0, sums);
        },
        ground(mu));
    if (load < 1) {
      EXPECT_EQ(pair.x[1] - pair.x[0], length[0] + stretch);
    } else {
      EXPECT_LT(pair.x[1] - pair.x[0], length[0] + mu * g / k);
    }
  }
}

TEST(Ground, StopsWhatWouldSinkAndNothingElse) {
  // Above, coming down less, just, and more than it may within the drift; on the ground, sinking,
  // resting, leaving; below, sinking and leaving.
  const std::vector<double> y = {0.5, 0.5, 0.5, 0, 0, 0, -0.25, -0.25};
  const std::vector<double> before = {-1, -2, -3, -1, 0, 1, -1, 1};
  const std::vector<double> after = {-1, -2, -2, 0, 0, 1, 0, 1};
  const std::vector<double> x(y.size());
  std::vector<double> vx(y.size(), 1.0), vy = before;
  ground(0.25)(0.25, x, y, vx, vy, {});
  EXPECT_EQ(vy, after);
  // Friction takes a quarter of what the ground gave, and only then.
  for (std::size_t i = 0; i < y.size(); ++i) EXPECT_EQ(vx[i], 1 - 0.25 * (after[i] - before[i]));
}

TEST(Ground, PushesOnlyUpwardsAndTakesEnergy) {
  evolve::RandomStream random(evolve::Purpose::test, 2, 0, 0);
  int met = 0;
  for (int i = 0; i < 10000; ++i) {
    const double y = 0.2 * random.triangular(), vx = random.triangular(), vy = random.triangular();
    double new_vx = vx, new_vy = vy;
    ref::meet_ground(y, h, random.uniform(), new_vx, new_vy);
    EXPECT_GE(new_vy, vy);
    EXPECT_LE(std::fabs(new_vx), std::fabs(vx));
    EXPECT_LE(std::fabs(new_vy), std::fabs(vy));
    EXPECT_GE(new_vx * vx, 0);
    // Where it is after the drift: at 0 or above, or no deeper than before.
    EXPECT_GE(y + h * new_vy, std::min(y, 0.0) - round_off_64);
    met += new_vy != vy;
  }
  EXPECT_GT(met, 1000);
}

TEST(Ground, ADroppedBlockComesToRestOnItWithoutEverBeingBelow) {
  // One that falls is stopped within the two steps around its landing, whatever its speed: there is
  // nothing elastic. Half a step before the first midpoint at the ground it is above it.
  evolve::RandomStream random(evolve::Purpose::test, 3, 0, 0);
  for (int i = 0; i < 100; ++i) {
    Block block(0);
    block.point.y[0] = random.uniform();
    block.point.vy[0] = random.triangular();
    double energy = block.energy();
    for (int n = 0; n < 4000; ++n) {
      block.slide(0.8, h);
      // The last drift to the ground rounds.
      ASSERT_GE(block.point.y[0], -2 * round_off_64);
      // A fall takes no energy and the stop takes what it has (proven for the step of landing:
      // h g |v| (e - 1) + (h g)^2 e (e - 1) / 2, e in [0, 1] the part of the kick it lets pass).
      ASSERT_LE(block.energy(), energy + 64 * round_off_64);
      energy = block.energy();
    }
    EXPECT_TRUE(within(block.point.y[0], 2 * round_off_64));
    EXPECT_EQ(block.point.vy[0], 0);
    EXPECT_EQ(block.point.vx[0], 0);
  }
}

TEST(Friction, StaysInItsConeAndNeverTurnsTheMotion) {
  evolve::RandomStream random(evolve::Purpose::test, 1, 0, 0);
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
