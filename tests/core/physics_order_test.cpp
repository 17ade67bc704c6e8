#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/reference/system.h"
#include "metamorph/scene.h"
#include "tests/bodies.h"
#include "tests/physics.h"
#include "tests/reference_methods.h"
#include "tests/tolerance.h"

namespace metamorph::tests {
namespace {

using core::ReferenceMethod;
using core::ReferenceSystem;

struct Places {
  std::vector<double> x, y;
};

/// Where a swimmer's nodes are after `duration`.
Places swim(ReferenceMethod method, double h, double duration, bool in_contact = false) {
  core::Scene scene = in_contact ? crowded(core::water_scene()) : core::water_scene();
  scene.self_collision = in_contact;
  ReferenceSystem system(strip_body(16), scene);
  for (long n = 0; n < std::lround(duration / h); ++n)
    system.step(method, static_cast<double>(n) * h, h);
  return {system.x, system.y};
}

class Order : public testing::TestWithParam<MethodOfOrder> {};

INSTANTIATE_TEST_SUITE_P(Reference, Order, testing::ValuesIn(reference_methods),
                         testing::PrintToStringParamName());

TEST_P(Order, InWaterByHalving) {
  // Errors against RK4 at 0.00625, whose own error is far below the smallest compared. The ramp
  // ends at t = 40, a whole number of steps. The drag v|v| has a kink in its second derivative
  // where v changes sign, which single halvings of RK4 feel; the three together do not.
  constexpr double duration = 80;
  static const Places exact = swim(ReferenceMethod::runge_kutta_4, 0.00625, duration);
  std::vector<double> error;
  for (const double h : {0.2, 0.1, 0.05, 0.025}) {
    const Places places = swim(GetParam().method, h, duration);
    error.push_back(rms_distance(places.x, places.y, exact.x, exact.y));
  }
  const double order = std::log2(error.front() / error.back()) / 3;
  EXPECT_TRUE(within(order - GetParam().order, tolerance::order))
      << "order " << order << ", errors " << error[0] << " " << error[1] << " " << error[2] << " "
      << error[3];
}

TEST_P(Order, InWaterInContactWithItselfByHalving) {
  // Repulsion has a kink where it begins, which leaves a method its second order at most.
  constexpr double duration = 80;
  static const Places exact = swim(ReferenceMethod::drift_kick_drift, 0.003125, duration, true);
  std::vector<double> error;
  for (const double h : {0.2, 0.1, 0.05, 0.025}) {
    const Places places = swim(GetParam().method, h, duration, true);
    error.push_back(rms_distance(places.x, places.y, exact.x, exact.y));
  }
  const double order = std::log2(error.front() / error.back()) / 3;
  EXPECT_GT(order, std::min(GetParam().order, 2) - 2 * tolerance::order)
      << "errors " << error[0] << " " << error[1] << " " << error[2] << " " << error[3];
}

/// The mean position of a body that walks on flat land for 100 time units.
double walk(double h) {
  core::Scene scene = core::land_scene();
  ReferenceSystem system(strip_body(16), scene);
  system.set_settling(true);
  for (long n = 0; n < std::lround(200 / h); ++n)
    system.step(ReferenceMethod::drift_kick_drift, 0, h);
  system.set_settling(false);
  for (long n = 0; n < std::lround(100 / h); ++n)
    system.step(ReferenceMethod::drift_kick_drift, static_cast<double>(n) * h, h);
  return system.mean_position()[0];
}

TEST(Order, OnLandItConverges) {
  // Stick and slip make the motion non-smooth: no order is claimed, but a quarter of the step must
  // be nearer, and on the whole the errors must fall at least in proportion to the step.
  const double exact = walk(0.003125);
  std::vector<double> error;
  for (const double h : {0.1, 0.05, 0.025, 0.0125}) error.push_back(std::fabs(walk(h) - exact));
  for (std::size_t i = 0; i < error.size(); ++i)
    RecordProperty("error_" + std::to_string(i), std::to_string(error[i]));
  EXPECT_LT(error[2], error[0]);
  EXPECT_LT(error[3], error[1]);
  EXPECT_GT(std::log2(error[0] / error[3]) / 3, 0.8)
      << error[0] << " " << error[1] << " " << error[2] << " " << error[3];
}

}  // namespace
}  // namespace metamorph::tests
