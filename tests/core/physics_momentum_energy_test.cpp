#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/reference/system.h"
#include "metamorph/scene.h"
#include "tests/bodies.h"
#include "tests/core/energy_record.h"
#include "tests/physics.h"
#include "tests/tolerance.h"

namespace metamorph::tests {
namespace {

using core::ReferenceMethod;
using core::ReferenceSystem;

struct Momentum {
  double x = 0, y = 0, angular = 0;
};

Momentum momentum(const ReferenceSystem& system) {
  Momentum sum;
  for (std::size_t i = 0; i < system.x.size(); ++i) {
    sum.x += system.vx[i];
    sum.y += system.vy[i];
    sum.angular += system.x[i] * system.vy[i] - system.y[i] * system.vx[i];
  }
  return sum;
}

/// Momentum of a free, damped and actuated body after 10,000 steps of 0.1, against the start.
Momentum momentum_change(ReferenceMethod method) {
  core::Scene scene = vacuum_scene();
  scene.damping = 0.2;
  scene.amplitude = 0.15;
  scene.self_collision = true;
  ReferenceSystem system(blob_body(30, 1), scene);
  disturb(system, 0.05, 0.05, 1);
  const Momentum start = momentum(system);
  for (int n = 0; n < 10000; ++n) system.step(method, 0.1 * n, 0.1);
  const Momentum end = momentum(system);
  return {end.x - start.x, end.y - start.y, end.angular - start.angular};
}

TEST(FreeBody, KeepsItsMomentum) {
  // 30 nodes of speeds up to 0.3, places up to 40: forces are pairwise opposite up to rounding, and
  // symplectic Euler and drift-kick-drift apply them at the places where they are central.
  for (const ReferenceMethod method :
       {ReferenceMethod::symplectic_euler, ReferenceMethod::drift_kick_drift}) {
    const Momentum change = momentum_change(method);
    const double linear = tolerance::drift(round_off_64, 30 * 0.3, 1e4);
    EXPECT_TRUE(within(change.x, linear));
    EXPECT_TRUE(within(change.y, linear));
    EXPECT_TRUE(within(change.angular, 40 * linear));
  }
}

TEST(FreeBody, RungeKuttaKeepsLinearMomentumExactlyAndAngularToItsOrder) {
  const Momentum change = momentum_change(ReferenceMethod::runge_kutta_4);
  const double linear = tolerance::drift(round_off_64, 30 * 0.3, 1e4);
  EXPECT_TRUE(within(change.x, linear));
  EXPECT_TRUE(within(change.y, linear));
  // Local error (w h)^5/5! = 2.8e-5 of an oscillation of 0.05 d at 0.15 d per time unit in 30
  // nodes, over 1e4 steps, of which damping leaves the first hundred.
  EXPECT_TRUE(within(change.angular, 2.8e-5 * 0.05 * 0.15 * 30 * 100));
}

TEST(Energy, DriftKickDriftStaysNearItAndHasNoTrend) {
  double last = 0;
  for (const double h : {0.2, 0.1, 0.05}) {
    const EnergyRecord record = energy_record(ReferenceMethod::drift_kick_drift, h, 1000);
    const double largest = std::max(record.first_half, record.second_half);
    EXPECT_TRUE(within(largest, leapfrog_energy_error(h))) << "h " << h;
    // No trend: rounding and the luck of extremes aside, the halves deviate alike.
    EXPECT_TRUE(within(growth(record), 0.25)) << "h " << h;
    if (last > 0) {
      EXPECT_TRUE(within(largest / last - 0.25, 0.05)) << "h " << h;
    }
    last = largest;
  }
}

TEST(Energy, SymplecticEulerErrsInProportionToTheStep) {
  double last = 0;
  for (const double h : {0.1, 0.05, 0.025}) {
    const EnergyRecord record = energy_record(ReferenceMethod::symplectic_euler, h, 1000);
    const double largest = std::max(record.first_half, record.second_half);
    EXPECT_TRUE(within(growth(record), 0.25)) << "h " << h;
    if (last > 0) {
      EXPECT_TRUE(within(largest / last - 0.5, 0.1)) << "h " << h;
    }
    last = largest;
  }
}

TEST(Energy, RungeKuttaLosesAndTheMidpointRuleGains) {
  // Per step an oscillation of frequency w changes its energy by -(w h)^6/72 under RK4 and by
  // +(w h)^4/4 under the midpoint rule.
  const EnergyRecord lossy = energy_record(ReferenceMethod::runge_kutta_4, 0.2, 200);
  EXPECT_LT(lossy.last, -1e-4);
  EXPECT_EQ(std::max(lossy.first_half, lossy.second_half), -lossy.last);
  const EnergyRecord growing = energy_record(ReferenceMethod::midpoint, 0.1, 200);
  EXPECT_GT(growing.last, 0.1);
  EXPECT_GT(growing.second_half, growing.first_half);
}

TEST(FreeFall, MovesEveryNodeAlikeWhateverTheBodyIs) {
  core::Scene scene = core::land_scene();
  scene.amplitude = 0;
  ReferenceSystem system(blob_body(40, 5), scene);
  for (double& y : system.y) y += 16;
  const std::vector<double> x = system.x, y = system.y;
  for (int n = 0; n < 200; ++n) system.step(ReferenceMethod::drift_kick_drift, 0.1 * n, 0.1);
  // y = y0 - g t^2/2; rounding of places up to 32.
  const double rounding = tolerance::drift(round_off_64, 32, 200);
  double sideways = 0, fall = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sideways = std::max(sideways, std::fabs(system.x[i] - x[i]));
    fall = std::max(fall, std::fabs(system.y[i] - y[i] + 0.02 * 20 * 20 / 2));
  }
  EXPECT_TRUE(within(sideways, rounding));
  EXPECT_TRUE(within(fall, rounding));
}

TEST(Mass, ScalesWithStiffnessDampingAndDragBitByBit) {
  // Twice everything that makes a force moves twice the mass alike.
  core::Scene scene = core::water_scene();
  core::Scene heavy = scene;
  heavy.stiffness *= 2;
  heavy.damping *= 2;
  heavy.pressure *= 2;
  heavy.drag_normal *= 2;
  heavy.drag_tangential *= 2;
  heavy.collision_stiffness *= 2;
  const core::Body body = blob_body(30, 6);
  ReferenceSystem one(body, scene), two(body, heavy);
  two.mass = 2;
  for (int n = 0; n < 1000; ++n) {
    one.step(ReferenceMethod::drift_kick_drift, 0.2 * n, 0.2);
    two.step(ReferenceMethod::drift_kick_drift, 0.2 * n, 0.2);
  }
  EXPECT_EQ(one.x, two.x);
  EXPECT_EQ(one.y, two.y);
}

}  // namespace
}  // namespace metamorph::tests
