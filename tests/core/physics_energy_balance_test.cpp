#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/reference/system.h"
#include "kernels/reference/drag.h"
#include "kernels/reference/solid.h"
#include "kernels/reference/spring.h"
#include "metamorph/scene.h"
#include "tests/bodies.h"
#include "tests/physics.h"
#include "tests/reference_methods.h"
#include "tests/tolerance.h"

// What a body gains in energy is the work of its muscles less what dampers, water, ground and
// friction take (NUMERICS section 8, test 8).

namespace metamorph::tests {
namespace {

using core::ReferenceMethod;
using core::ReferenceSystem;

/// What the forces that are not conservative do: power at one moment.
double power(ReferenceSystem& system, const core::Body& body, const core::Scene& scene, double t) {
  const std::size_t n = body.x.size();
  std::vector<double> fx(n), fy(n);
  const kernels::reference::Forces sums{fx, fy};
  kernels::reference::add_spring_forces(body.springs, body.rest_length, 0, scene.damping,
                                        system.nodes(), sums);
  if (scene.drag)
    kernels::reference::add_drag_forces(system.outline(), scene.drag_normal, scene.drag_tangential,
                                        system.nodes(), sums);
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) sum += fx[i] * system.vx[i] + fy[i] * system.vy[i];
  // Actuation moves the rest lengths: the energy that the springs gain while nobody moves.
  constexpr double delta = 1e-4;
  return sum +
         (system.potential_energy(t + delta) - system.potential_energy(t - delta)) / (2 * delta);
}

/// The change of energy that no work explains, at most, over the work done in one direction.
double unexplained_energy(ReferenceMethod method, double h, core::Scene scene, double duration) {
  scene.ramp_steps = 0;  // the end of a ramp would be a kink
  scene.self_collision = false;
  const core::Body body = strip_body(16);
  ReferenceSystem system(body, scene);
  constexpr double begin = 1;  // in the midst of the oscillation
  const double start = system.potential_energy(begin) + system.kinetic_energy();
  double work = 0, turnover = 0, largest = 0;
  double first = power(system, body, scene, begin);
  for (long n = 0; n < std::lround(duration / h); n += 2) {
    const double t = begin + static_cast<double>(n) * h;
    system.step(method, t, h);
    const double middle = power(system, body, scene, t + h);
    system.step(method, t + h, h);
    const double last = power(system, body, scene, t + 2 * h);
    work += h / 3 * (first + 4 * middle + last);  // Simpson: of fourth order
    turnover += h / 3 * (std::fabs(first) + 4 * std::fabs(middle) + std::fabs(last));
    first = last;
    largest = std::max(largest, std::fabs(system.potential_energy(t + 2 * h) +
                                          system.kinetic_energy() - start - work));
  }
  return largest / turnover;
}

class EnergyBalance : public testing::TestWithParam<MethodOfOrder> {};

INSTANTIATE_TEST_SUITE_P(Reference, EnergyBalance, testing::ValuesIn(reference_methods),
                         testing::PrintToStringParamName());

TEST_P(EnergyBalance, InWaterClosesWithTheMethodsOrder) {
  std::vector<double> left;
  for (const double h : {0.05, 0.025, 0.0125, 0.00625})
    left.push_back(unexplained_energy(GetParam().method, h, core::water_scene(), 40));
  const double order = std::log2(left.front() / left.back()) / 3;
  EXPECT_TRUE(within(order - GetParam().order, tolerance::order))
      << "order " << order << ", unexplained " << left[0] << " " << left[1] << " " << left[2] << " "
      << left[3];
}

/// What acts by impulses does work at once: the change of kinetic energy across it.
struct LandBalance {
  double unexplained = 0, turnover = 0;
  double gained = 0;  ///< by impulses, at most in one step
  double taken = 0;   ///< by them, in all
};

/// A walker by symplectic Euler: its kick, impulses and drift in turn, so that the work of every
/// part can be told.
LandBalance land_balance(double h, double duration) {
  core::Scene scene = core::land_scene();
  scene.ramp_steps = 0;
  const core::Body body = strip_body(16);
  ReferenceSystem system(body, scene);
  const std::size_t n = body.x.size();
  std::vector<double> fx(n), fy(n);
  constexpr double begin = 1;  // in the midst of the oscillation
  const double start = system.potential_energy(begin) + system.kinetic_energy();
  double work = 0;
  LandBalance balance;
  for (long step = 0; step < std::lround(duration / h); ++step) {
    const double t = begin + static_cast<double>(step) * h;
    work += h * power(system, body, scene, t);
    balance.turnover += h * std::fabs(power(system, body, scene, t));
    system.forces(system.nodes(), t, {fx, fy});
    for (std::size_t i = 0; i < n; ++i) {
      system.vx[i] += h * fx[i];
      system.vy[i] += h * fy[i];
    }
    const double before = system.kinetic_energy();
    kernels::reference::keep_apart(system.solid(), h, system.x, system.y, system.vx, system.vy);
    const double change = system.kinetic_energy() - before;
    work += change;
    balance.gained = std::max(balance.gained, change);
    balance.taken -= change;
    for (std::size_t i = 0; i < n; ++i) {
      system.x[i] += h * system.vx[i];
      system.y[i] += h * system.vy[i];
    }
    balance.unexplained = std::max(
        balance.unexplained,
        std::fabs(system.potential_energy(t + h) + system.kinetic_energy() - start - work));
  }
  return balance;
}

TEST(EnergyBalance, OnLandClosesWithTheStepAndImpulsesOnlyTake) {
  // Of first order, and contact switches within steps: it must fall at least in proportion to the
  // step on the whole.
  std::vector<double> left;
  for (const double h : {0.1, 0.05, 0.025, 0.0125}) {
    const LandBalance balance = land_balance(h, 40);
    left.push_back(balance.unexplained / (balance.turnover + balance.taken));
    EXPECT_TRUE(within(balance.gained, 64 * round_off_64));
    EXPECT_GT(balance.taken, 0.01);
  }
  EXPECT_TRUE(within(left[2], left[0]));
  EXPECT_TRUE(within(left[3], left[1]));
  EXPECT_GT(std::log2(left[0] / left[3]) / 3, 0.8)
      << left[0] << " " << left[1] << " " << left[2] << " " << left[3];
}

}  // namespace
}  // namespace metamorph::tests
