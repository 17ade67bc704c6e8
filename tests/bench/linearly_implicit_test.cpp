#include "bench/accuracy/linearly_implicit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <ostream>
#include <string>
#include <vector>

#include "bench/accuracy/xpbd.h"
#include "core/reference/system.h"
#include "metamorph/scene.h"
#include "tests/bodies.h"
#include "tests/physics.h"
#include "tests/tolerance.h"

// The methods that exist for comparison only must be what they are called, or nothing is compared.

namespace metamorph::tests {
namespace {

using core::ReferenceMethod;
using core::ReferenceSystem;

using Stepper = std::function<void(ReferenceSystem&, double t, double h)>;

struct Comparison {
  std::string name;
  int order;
  Stepper (*make)(const core::Body&, const core::Scene&);
};

std::ostream& operator<<(std::ostream& out, const Comparison& c) { return out << c.name; }

template <class Method>
Stepper make(const core::Body& body, const core::Scene& scene) {
  const auto method = std::make_shared<Method>(body, scene);  // holds a factorisation: no copies
  return [=](ReferenceSystem& system, double t, double h) { method->step(system, t, h); };
}

Stepper make_runge_kutta(const core::Body&, const core::Scene&) {
  return [](ReferenceSystem& system, double t, double h) {
    system.step(ReferenceMethod::runge_kutta_4, t, h);
  };
}

struct Places {
  std::vector<double> x, y;
};

/// Where a swimmer's nodes are after twice the ramp.
Places swim(const Comparison& method, double h) {
  core::Scene scene = core::water_scene();
  scene.self_collision = false;
  const core::Body body = strip_body(16);
  ReferenceSystem system(body, scene);
  const Stepper step = method.make(body, scene);
  for (long n = 0; n < std::lround(80 / h); ++n) step(system, static_cast<double>(n) * h, h);
  return {system.x, system.y};
}

class ComparisonOrder : public testing::TestWithParam<Comparison> {};

INSTANTIATE_TEST_SUITE_P(Bench, ComparisonOrder,
                         testing::Values(Comparison{"LinearlyImplicitEuler", 1,
                                                    make<bench::LinearlyImplicitEuler>},
                                         Comparison{"Rosenbrock2", 2, make<bench::Rosenbrock2>},
                                         Comparison{"Xpbd", 1, make<bench::Xpbd>}),
                         testing::PrintToStringParamName());

TEST_P(ComparisonOrder, InWaterByHalving) {
  // Errors against RK4 at 0.0125, whose own is far below the smallest compared. With steps of 0.05
  // and less the next term of every error is small against its first.
  static const Places exact = swim({"RungeKutta4", 4, make_runge_kutta}, 0.0125);
  std::vector<double> error;
  for (const double h : {0.05, 0.025, 0.0125, 0.00625}) {
    const Places places = swim(GetParam(), h);
    error.push_back(rms_distance(places.x, places.y, exact.x, exact.y));
  }
  const double order = std::log2(error.front() / error.back()) / 3;
  EXPECT_TRUE(within(order - GetParam().order, tolerance::order))
      << "order " << order << ", errors " << error[0] << " " << error[1] << " " << error[2] << " "
      << error[3];
}

/// A body at rest in still water: all forces are those of springs, dampers and pressure.
ReferenceSystem at_rest(const core::Body& body) {
  core::Scene scene = core::water_scene();
  scene.self_collision = false;
  return ReferenceSystem(body, scene);
}

TEST(ImplicitMatrix, AtRestIsMinusTheJacobianOfTheForces) {
  // Central differences of the forces by place (K) and by velocity (C). Forces are of size 1 and
  // their third derivatives by place below 100 (k/l^2, c_p S0/S^3); by velocity they are linear but
  // for the drag, whose v|v| leaves delta d_N L < 2 delta.
  const core::Body body = blob_body(20, 3);
  ReferenceSystem system = at_rest(body);
  core::Scene scene = core::water_scene();
  const std::size_t n = body.x.size();
  std::vector<double> fx(n), fy(n);
  bench::ImplicitMatrix matrix(body, scene);
  matrix.factorise(system, 0, 1);
  const Eigen::MatrixXd stiffness(matrix.stiffness());
  matrix.factorise(system, 1, 0);
  const Eigen::MatrixXd damping = Eigen::MatrixXd(matrix.left_side()) -
                                  Eigen::MatrixXd::Identity(stiffness.rows(), stiffness.cols());

  const auto difference = [&](std::vector<double>& of, double delta, std::size_t node) {
    Eigen::VectorXd result(static_cast<Eigen::Index>(2 * n));
    const double before = of[node];
    for (const double sign : {1.0, -1.0}) {
      of[node] = before + sign * delta;
      system.forces(system.nodes(), 0, {fx, fy});
      for (std::size_t i = 0; i < n; ++i) {
        const auto place = static_cast<Eigen::Index>(2 * i);
        result[place] = (sign > 0 ? 0.0 : result[place]) + sign * fx[i] / (2 * delta);
        result[place + 1] = (sign > 0 ? 0.0 : result[place + 1]) + sign * fy[i] / (2 * delta);
      }
    }
    of[node] = before;
    return result;
  };
  double of_places = 0, of_velocities = 0;
  constexpr double delta = 1e-5, slow = 1e-9;
  for (std::size_t node = 0; node < n; ++node) {
    const auto column = static_cast<Eigen::Index>(2 * node);
    const auto error = [&](const Eigen::MatrixXd& m, Eigen::Index c, const Eigen::VectorXd& d) {
      return (m.col(c) + d).cwiseAbs().maxCoeff();
    };
    of_places = std::max({of_places, error(stiffness, column, difference(system.x, delta, node)),
                          error(stiffness, column + 1, difference(system.y, delta, node))});
    of_velocities =
        std::max({of_velocities, error(damping, column, difference(system.vx, slow, node)),
                  error(damping, column + 1, difference(system.vy, slow, node))});
  }
  EXPECT_TRUE(within(of_places, tolerance::central_difference(delta, 1, 100)));
  // Forces at rest are rounding of lengths of 1 and of velocities of 1e-9.
  EXPECT_TRUE(within(of_velocities, 2 * slow + 64 * round_off_64 / slow));
}

TEST(Rosenbrock2, SticksOnASlopeAndSlidesAsTheoryHasIt) {
  // As the methods of the program do: its friction is the same impulse.
  const core::Body body = strip_body(12);
  for (const double mu : {0.2, 0.8}) {
    core::Scene scene = core::slope_scene();
    scene.amplitude = 0;
    scene.friction = mu;
    ReferenceSystem system(body, scene);
    const Stepper step = make<bench::Rosenbrock2>(body, scene);
    for (long n = 0; n < 4000; ++n) step(system, 0, 0.1);
    const double early = mean(system.vx);
    for (long n = 0; n < 2000; ++n) step(system, 0, 0.1);
    const double angle = std::numbers::pi * 17 / 180;
    const double a = mu > std::tan(angle) ? 0 : std::sin(angle) - mu * std::cos(angle);
    // 2e-4 g (NUMERICS section 8, test 13).
    EXPECT_TRUE(within((mean(system.vx) - early) / (200 * 0.02) + a, 2e-4)) << "mu " << mu;
  }
}

}  // namespace
}  // namespace metamorph::tests
