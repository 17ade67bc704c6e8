#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "kernels/reference/gravity.h"
#include "kernels/reference/spring.h"
#include "tests/kernels/points.h"
#include "tests/tolerance.h"

namespace metamorph::tests {
namespace {

class EveryIntegrator : public testing::TestWithParam<Integrator> {};

INSTANTIATE_TEST_SUITE_P(Reference, EveryIntegrator, testing::ValuesIn(all_integrators()),
                         testing::PrintToStringParamName());

/// Largest error over [0, 20] of a damped pair: two nodes of mass 1 on a spring with k = 1 and
/// c = 0.2, drawn out by x0. The stretch u obeys u'' = -2k u - 2c u', so
/// u = x0 e^(-c t) (cos w t + c/w sin w t), w^2 = 2k - c^2.
double damped_pair_error(const Integrator& integrator, double h) {
  constexpr double k = 1, c = 0.2, rest = 1, x0 = 0.1;
  const std::vector<ref::Edge> springs = {{0, 1}};
  const std::vector<double> length = {rest};
  const double w = std::sqrt(2 * k - c * c);
  Points pair(2);
  pair.x[1] = rest + x0;
  double largest = 0;
  const ForceLaw law = [&](const ref::Nodes& nodes, double, const ref::Forces& sums) {
    ref::add_spring_forces(springs, length, k, c, nodes, sums);
  };
  for (long n = 1; n <= std::lround(20 / h); ++n) {
    integrate(pair, integrator, h, h, law);
    const double t = static_cast<double>(n) * h;
    const double exact = x0 * std::exp(-c * t) * (std::cos(w * t) + c / w * std::sin(w * t));
    largest = std::max(largest, std::fabs(pair.x[1] - pair.x[0] - rest - exact));
  }
  return largest / x0;
}

TEST_P(EveryIntegrator, MovesADampedPairAsTheoryWithItsOrder) {
  double last = 0;
  for (const double h : {0.1, 0.05, 0.025}) {
    const double error = damped_pair_error(GetParam(), h);
    if (last > 0) {
      EXPECT_TRUE(within(std::log2(last / error) - GetParam().order, tolerance::order))
          << "h " << h << ", error " << error;
    }
    last = error;
  }
}

TEST(DampedPair, IsAsAccurateAsItsMethodAllows) {
  // Leading error terms of the two methods over one decay time 1/c = 5 at w = 1.4, h = 0.1: phase
  // (w h)^2/24 w t = 0.6 % for a second-order method, and (w h)^5/120 steps = 2e-5 for RK4.
  EXPECT_TRUE(within(damped_pair_error(drift_kick_drift, 0.1), 6e-3));
  EXPECT_TRUE(within(damped_pair_error(runge_kutta_4, 0.1), 2e-5));
}

TEST_P(EveryIntegrator, FallsFreely) {
  // y = y0 + v0 t - g t^2/2; what a method of second order computes without error. Symplectic Euler
  // falls g h t/2 too far.
  constexpr double g = 0.02, t = 20, h = 0.1, y0 = 8, v0 = 0.5;
  Points point(1);
  point.y[0] = y0;
  point.vy[0] = v0;
  integrate(point, GetParam(), t, h, [](const ref::Nodes&, double, const ref::Forces& sums) {
    ref::add_weight({0, -g}, 1.0, sums);
  });
  const double late = GetParam().order == 1 ? g * h * t / 2 : 0;
  const double rounding = tolerance::drift(round_off_64, y0 + v0 * t, t / h);
  // Drift-kick-drift and the Runge-Kutta sums round their h and weights once each per step.
  EXPECT_TRUE(within(point.y[0] - (y0 + v0 * t - g * t * t / 2 - late), rounding));
  EXPECT_TRUE(within(point.vy[0] - (v0 - g * t), rounding));
}

TEST(DriftKickDrift, RemembersTheAccelerationWithImpulses) {
  Points point(1);
  point.vx[0] = 1;
  const ForceLaw law = [](const ref::Nodes&, double, const ref::Forces& sums) {
    sums.x[0] += 0.25;
    sums.y[0] += 0.5;
  };
  const Keep keep = [](double h, std::span<const double> x, std::span<const double>,
                       std::span<double> vx, std::span<double> vy, std::span<double>) {
    EXPECT_EQ(h, 0.5);        // to the middle of the next step
    EXPECT_EQ(x[0], 0.25);    // from that of this one
    EXPECT_EQ(vx[0], 1.125);  // after the kick
    vx[0] -= 0.0625;
    vy[0] = 0;
  };
  integrate(point, drift_kick_drift, 0.5, 0.5, law, keep);
  EXPECT_EQ(point.ax[0], 0.25 - 0.0625 / 0.5);
  EXPECT_EQ(point.ay[0], 0);
  EXPECT_EQ(point.vx[0], 1 + 0.5 * 0.25 - 0.0625);
  EXPECT_EQ(point.x[0], 0.25 + 0.25 * point.vx[0]);
}

TEST_P(EveryIntegrator, AsksOnceAStepWhereADriftByItLeads) {
  // Where what is kept apart would be a step after the places it is told.
  Points point(1);
  point.x[0] = 4;
  point.vx[0] = 1;
  int asked = 0;
  const Keep keep = [&](double h, std::span<const double> x, std::span<const double>,
                        std::span<double> vx, std::span<double>, std::span<double>) {
    ++asked;
    EXPECT_EQ(h, 0.125);
    EXPECT_GE(x[0], 4);
    EXPECT_LE(x[0], 4.0625);
    EXPECT_DOUBLE_EQ(vx[0], 1);  // Runge-Kutta's weights are rounded
    vx[0] -= 2;
  };
  integrate(
      point, GetParam(), 0.125, 0.125, [](const ref::Nodes&, double, const ref::Forces&) {}, keep);
  EXPECT_EQ(asked, 1);
  EXPECT_DOUBLE_EQ(point.vx[0], -1);
  // Drift-kick-drift has drifted half of the way there before.
  EXPECT_DOUBLE_EQ(point.x[0], GetParam().name == "DriftKickDrift" ? 4 : 3.875);
}

}  // namespace
}  // namespace metamorph::tests
