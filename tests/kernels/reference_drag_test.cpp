#include "kernels/reference/drag.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "kernels/reference/gravity.h"
#include "metamorph/random.h"
#include "tests/kernels/points.h"
#include "tests/tolerance.h"

namespace metamorph::tests {
namespace {

constexpr double length = 2;
const std::vector<ref::Edge> edge = {{0, 1}};

/// An edge of length 2 along x.
Points rod() {
  Points points(2);
  points.x[1] = length;
  return points;
}

ForceLaw drag_law(double normal, double tangential) {
  return [=](const ref::Nodes& nodes, double, const ref::Forces& sums) {
    ref::add_drag_forces(edge, normal, tangential, nodes, sums);
  };
}

/// Relative error at t = 20 of v = v0/(1 + d L v0 t/(2m)), the speed of one edge with two nodes of
/// mass m, moving across or along itself.
double decay_error(const Integrator& integrator, bool across, double h) {
  constexpr double v0 = 1, d = 0.5, t = 20, mass = 1;
  Points points = rod();
  (across ? points.vy : points.vx) = {v0, v0};
  integrate(points, integrator, t, h, across ? drag_law(d, 0) : drag_law(0, d), keep_nothing, mass);
  const double exact = v0 / (1 + d * length * v0 * t / (2 * mass));
  return std::fabs((across ? points.vy : points.vx)[0] / exact - 1);
}

class DragDecay : public testing::TestWithParam<Integrator> {};

INSTANTIATE_TEST_SUITE_P(Reference, DragDecay, testing::ValuesIn(all_integrators()),
                         testing::PrintToStringParamName());

TEST_P(DragDecay, FollowsTheHyperbolaWithTheMethodsOrder) {
  for (const bool across : {true, false}) {
    double last = 0;
    for (const double h : {0.1, 0.05, 0.025}) {
      const double error = decay_error(GetParam(), across, h);
      if (last > 0) {
        EXPECT_TRUE(within(std::log2(last / error) - GetParam().order, tolerance::order))
            << "h " << h << ", error " << error;
      }
      last = error;
    }
  }
}

TEST(Drag, DecayIsAsAccurateAsTheMethodsAllow) {
  // The rate d L v0/(2m) = 0.5: (0.5 h)^2 = 2.5e-3 for second order, of which about an eighth is
  // left after the first lapse; (0.5 h)^4/5! = 5e-8 for RK4.
  for (const bool across : {true, false}) {
    EXPECT_TRUE(within(decay_error(drift_kick_drift, across, 0.1), 1e-3));
    EXPECT_TRUE(within(decay_error(runge_kutta_4, across, 0.1), 1e-6));
  }
}

TEST(Drag, TerminalVelocityIsWhereDragCarriesTheWeight) {
  // 2 m g = d L v^2. The approach is e^(-2 g t/v), gone at t = 400.
  constexpr double d = 0.8, g = 0.1, mass = 1;
  const double terminal = std::sqrt(2 * mass * g / (d * length));
  Points points = rod();
  integrate(points, drift_kick_drift, 400, 0.1,
            [&](const ref::Nodes& nodes, double t, const ref::Forces& sums) {
              drag_law(d, 0)(nodes, t, sums);
              ref::add_weight({0, -g}, mass, sums);
            });
  EXPECT_TRUE(within(points.vy[0] / terminal + 1, 1e-12));
}

/// A random edge with random velocities.
Points random_rod(std::uint32_t seed) {
  evolve::RandomStream random(evolve::Purpose::test, seed, 0, 0);
  Points points(2);
  for (auto* values : {&points.x, &points.y, &points.vx, &points.vy})
    for (double& value : *values) value = 4 * random.uniform() - 2;
  return points;
}

TEST(Drag, NeverDoesWork) {
  for (std::uint32_t seed = 1; seed <= 1000; ++seed) {
    const Points points = random_rod(seed);
    std::vector<double> fx(2), fy(2);
    ref::add_drag_forces(edge, 1, 0.01, points.nodes(), {fx, fy});
    double power = 0;
    for (std::size_t i = 0; i < 2; ++i) power += fx[i] * points.vx[i] + fy[i] * points.vy[i];
    EXPECT_LE(power, 0);
  }
}

TEST(Drag, DoesNotDependOnTheDirectionOfTheEdge) {
  const std::vector<ref::Edge> reversed = {{1, 0}};
  for (std::uint32_t seed = 1; seed <= 1000; ++seed) {
    const Points points = random_rod(seed);
    std::vector<double> fx(2), fy(2), gx(2), gy(2);
    ref::add_drag_forces(edge, 1, 0.01, points.nodes(), {fx, fy});
    ref::add_drag_forces(reversed, 1, 0.01, points.nodes(), {gx, gy});
    EXPECT_EQ(fx, gx);
    EXPECT_EQ(fy, gy);
    EXPECT_EQ(fx[0], fx[1]);
    EXPECT_EQ(fy[0], fy[1]);
  }
}

TEST(Drag, NormalAndTangentialAreTheirCoefficientsApart) {
  Points points = rod();
  std::vector<double> fx(2), fy(2);
  points.vy = {0.5, 0.5};
  ref::add_drag_forces(edge, 100, 1, points.nodes(), {fx, fy});
  EXPECT_EQ(fx[0], 0);
  const double across = fy[0];
  points.vx = points.vy;
  points.vy = {0, 0};
  fx = fy = {0, 0};
  ref::add_drag_forces(edge, 100, 1, points.nodes(), {fx, fy});
  EXPECT_EQ(fy[0], 0);
  EXPECT_EQ(across, 100 * fx[0]);
  EXPECT_EQ(fx[0], -1 * length * 0.5 * 0.5 / 2);
}

TEST(Drag, ARotatingEdgeIsJudgedByItsCentre) {
  Points points = rod();
  points.vy = {1, -1};
  std::vector<double> fx(2), fy(2);
  ref::add_drag_forces(edge, 1, 0.01, points.nodes(), {fx, fy});
  EXPECT_EQ(fy[0], 0);
  EXPECT_EQ(fy[1], 0);
}

}  // namespace
}  // namespace metamorph::tests
