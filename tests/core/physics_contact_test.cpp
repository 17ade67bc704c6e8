#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/body/outline_crossing.h"
#include "core/reference/system.h"
#include "metamorph/scene.h"
#include "metamorph/status.h"
#include "tests/bodies.h"
#include "tests/core/energy_record.h"
#include "tests/physics.h"
#include "tests/reference_methods.h"
#include "tests/tolerance.h"

// A body that meets itself, gently and so hard that the penalty (0.18 per pair, see below) gives
// way and the stop must act. By the reference, without surroundings.

namespace metamorph::tests {
namespace {

using core::ReferenceMethod;
using core::ReferenceSystem;

core::Scene undamped_with_contact() {
  core::Scene scene = vacuum_scene();
  scene.self_collision = true;
  return scene;
}

double total_energy(ReferenceSystem& system) {
  return system.potential_energy(0) + system.kinetic_energy();
}

/// A step of drift-kick-drift; returns whether impulses acted in it, that is, whether it led to
/// other velocities than its kick.
bool step_with_impulses(ReferenceSystem& system, double h) {
  const ReferenceSystem before = system;
  const std::size_t n = before.x.size();
  std::vector<double> x(n), y(n), vx(n), vy(n), fx(n), fy(n);
  for (std::size_t i = 0; i < n; ++i) {
    x[i] = before.x[i] + h / 2 * before.vx[i];
    y[i] = before.y[i] + h / 2 * before.vy[i];
    vx[i] = before.vx[i] + h / 2 * before.ax[i];
    vy[i] = before.vy[i] + h / 2 * before.ay[i];
  }
  system.forces({x, y, vx, vy}, h / 2, {fx, fy});
  system.step(ReferenceMethod::drift_kick_drift, 0, h);
  for (std::size_t i = 0; i < n; ++i)
    if (system.vx[i] != before.vx[i] + h * fx[i] || system.vy[i] != before.vy[i] + h * fy[i])
      return true;
  return false;
}

/// What happens while the jaws are driven into each other.
struct Bite {
  double highest = 0, deviation = 0;  ///< of the energy over that of the start, less 1
  double smallest_gap = 1;            ///< of a pair over its threshold
  int stopped = 0;                    ///< steps in which the stop acted
  int crossed = 0;                    ///< steps after which the outline crossed itself
  double momentum = 0, angular = 0;   ///< their largest change
};

Bite bite(double speed, double h, double damping = 0) {
  core::Scene scene = undamped_with_contact();
  scene.damping = damping;
  ReferenceSystem system(jaws_body(), scene);
  for (std::size_t i = 0; i < system.x.size(); ++i)
    if (system.x[i] > 2.5) system.vy[i] = system.y[i] > 3 ? -speed : speed;
  const auto sums = [&](double& x, double& y, double& angular) {
    x = y = angular = 0;
    for (std::size_t i = 0; i < system.x.size(); ++i) {
      x += system.vx[i];
      y += system.vy[i];
      angular += system.x[i] * system.vy[i] - system.y[i] * system.vx[i];
    }
  };
  double x0, y0, angular0, x, y, angular;
  sums(x0, y0, angular0);
  const double start = total_energy(system);
  Bite result;
  for (long n = 0; n < std::lround(60 / h); ++n) {
    result.stopped += step_with_impulses(system, h);
    const double energy = total_energy(system) / start - 1;
    result.highest = std::max(result.highest, energy);
    result.deviation = std::max(result.deviation, std::fabs(energy));
    for (const auto& pair : system.collision_pairs()) {
      const double gap =
          kernels::reference::closest_point(pair.node, pair.edge, system.x, system.y).gap;
      result.smallest_gap = std::min(result.smallest_gap, gap / pair.threshold);
    }
    result.crossed += core::first_crossing(system.x, system.y, system.outline()).has_value();
    sums(x, y, angular);
    result.momentum = std::max({result.momentum, std::fabs(x - x0), std::fabs(y - y0)});
    result.angular = std::max(result.angular, std::fabs(angular - angular0));
  }
  return result;
}

TEST(SelfCollision, IsElasticWhereThePenaltyKeepsThingsApart) {
  // The force has a kink where contact begins, so that the second-order energy error of the
  // leapfrog need not fall by a full four per halving; it must fall.
  const Bite coarse = bite(0.3, 0.1), fine = bite(0.3, 0.05);
  for (const Bite& gentle : {coarse, fine}) {
    EXPECT_LT(gentle.smallest_gap, 0.9);  // they did touch
    EXPECT_EQ(gentle.stopped, 0);
    EXPECT_EQ(gentle.crossed, 0);
  }
  EXPECT_TRUE(within(coarse.deviation, leapfrog_energy_error(0.1)));
  EXPECT_TRUE(within(fine.deviation, coarse.deviation / 2));
}

TEST(SelfCollision, AHardBiteIsStoppedWithoutCrossingOrGainingEnergy) {
  // A pair's penalty holds k_s 0.3^2/2 = 0.18; a node of the jaws brings 0.5 to 2 and is pushed by
  // those behind it.
  // Undamped as fast as bears it without being squeezed flat; faster with the dampers of a body.
  struct Case {
    double speed, damping;
  };
  for (const auto& [speed, damping] : {Case{1.0, 0}, Case{1.25, 0}, Case{1.5, 0.4}, Case{2.0, 0.4}})
    for (const double h : {0.1, 0.2}) {
      const Bite hard = bite(speed, h, damping);
      SCOPED_TRACE("speed " + std::to_string(speed) + " step " + std::to_string(h));
      EXPECT_GT(hard.stopped, 0);
      EXPECT_EQ(hard.crossed, 0);
      EXPECT_TRUE(within(hard.highest, leapfrog_energy_error(h)));
      // 44 nodes of speeds up to 4 and places up to 16: pairwise opposite up to rounding.
      const double linear = tolerance::drift(round_off_64, 44 * 4, 60 / h);
      EXPECT_TRUE(within(hard.momentum, linear));
      EXPECT_TRUE(within(hard.angular, 16 * linear));
    }
}

TEST(SelfCollision, ABlobThrownTogetherKeepsItsMomentum) {
  // Towards its middle line from both sides, turning.
  for (const ReferenceMethod method :
       {ReferenceMethod::symplectic_euler, ReferenceMethod::drift_kick_drift}) {
    core::Scene scene = crowded(undamped_with_contact());
    scene.damping = 0.1;
    ReferenceSystem system(blob_body(30, 1), scene);
    double x0 = 0, y0 = 0, angular0 = 0, x = 0, y = 0, angular = 0;
    const auto middle = system.mean_position();
    for (std::size_t i = 0; i < system.x.size(); ++i) {
      system.vx[i] = 0.2 * (middle[0] - system.x[i]) - 0.1 * (system.y[i] - middle[1]);
      system.vy[i] = 0.1 * (system.x[i] - middle[0]) + 0.05;
      x0 += system.vx[i];
      y0 += system.vy[i];
      angular0 += system.x[i] * system.vy[i] - system.y[i] * system.vx[i];
    }
    for (int n = 0; n < 2000; ++n) system.step(method, 0, 0.1);
    for (std::size_t i = 0; i < system.x.size(); ++i) {
      x += system.vx[i];
      y += system.vy[i];
      angular += system.x[i] * system.vy[i] - system.y[i] * system.vx[i];
    }
    // Speeds of up to 1, places of up to 32.
    const double linear = tolerance::drift(round_off_64, 30, 2000);
    EXPECT_TRUE(within(x - x0, linear));
    EXPECT_TRUE(within(y - y0, linear));
    EXPECT_TRUE(within(angular - angular0, 32 * linear));
  }
}

}  // namespace
}  // namespace metamorph::tests
