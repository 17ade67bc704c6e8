// The same bits for any batch, order, thread count and neighbour; failures as data.

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "metamorph/locomotion.h"
#include "metamorph/random.h"
#include "metamorph/stability.h"
#include "tests/bodies.h"
#include "tests/core/short_tasks.h"
#include "tests/outcomes.h"

namespace metamorph::core {
namespace {

using tests::same_bits;
using tests::Tasks;

class Batch : public testing::TestWithParam<Precision> {
 protected:
  LocomotionOptions options(int threads) const {
    return {.precision = GetParam(), .threads = threads};
  }
};

TEST_P(Batch, EqualsSinglesForAnySizeAndOrder) {
  const Tasks all(60);
  const auto whole = simulate(all.tasks, options(1));
  for (std::size_t i = 0; i < all.tasks.size(); ++i) {
    EXPECT_TRUE(same_bits(whole[i], simulate({&all.tasks[i], 1}, options(1)).front()))
        << "task " << i;
  }
  std::vector<std::size_t> order(all.tasks.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  evolve::RandomStream random(evolve::Purpose::test, 5, 0, 0);
  for (std::size_t i = order.size() - 1; i > 0; --i) {
    std::swap(order[i], order[random.below(static_cast<std::uint32_t>(i + 1))]);
  }
  std::vector<LocomotionTask> shuffled;
  for (const std::size_t i : order) shuffled.push_back(all.tasks[i]);
  const auto results = simulate(shuffled, options(1));
  for (std::size_t i = 0; i < order.size(); ++i) {
    EXPECT_TRUE(same_bits(whole[order[i]], results[i])) << "task " << order[i];
  }
}

/// One way to fail, and what it must be called.
struct Failure {
  std::string name;
  Status status;
  void (*spoil)(Body&, Scene&);
};

std::ostream& operator<<(std::ostream& out, const Failure& failure) { return out << failure.name; }

const Failure failures[] = {
    {"NanPosition", Status::bad_input,
     [](Body& body, Scene&) { body.x[5] = std::numeric_limits<double>::quiet_NaN(); }},
    {"InfiniteRestLength", Status::bad_input,
     [](Body& body, Scene&) { body.rest_length[3] = std::numeric_limits<double>::infinity(); }},
    {"NegativePeriod", Status::bad_input, [](Body& body, Scene&) { body.period[2] = -30; }},
    {"CoincidentNodes", Status::bad_geometry,
     [](Body& body, Scene&) {
       body.x[body.triangles[0][0]] = body.x[body.triangles[0][1]];
       body.y[body.triangles[0][0]] = body.y[body.triangles[0][1]];
     }},
    {"ClockwiseTriangle", Status::bad_geometry,
     [](Body& body, Scene&) { std::swap(body.triangles[4][0], body.triangles[4][1]); }},
    {"IsolatedNode", Status::bad_topology,
     [](Body& body, Scene&) {
       body.x.push_back(100);
       body.y.push_back(100);
       body.period.push_back(30);
       body.phase.push_back(0);
     }},
    {"StiffSprings", Status::step_too_large, [](Body&, Scene& scene) { scene.stiffness = 100; }},
    {"StrongDamping", Status::step_too_large, [](Body&, Scene& scene) { scene.damping = 3; }},
    {"LargeStep", Status::step_too_large, [](Body&, Scene& scene) { scene.step = 1; }},
    {"ThrownIntoGravity", Status::speed,
     [](Body&, Scene& scene) {
       scene.drag = false;
       scene.ground = true;
       scene.step = 0.1;
       scene.slope_degrees = 85;
       scene.gravity = 1;
       scene.friction = 0;
       scene.settle_max_steps = 0;
       scene.run_steps = 3000;
     }},
    {"NoPressureAndHugeActuation", Status::inverted,
     [](Body& body, Scene& scene) {
       scene.pressure = 1e-6;
       scene.amplitude = 0.5;
       scene.ramp_steps = 1;
       for (double& period : body.period) period = 5;
       scene.run_steps = 3000;
     }},
    {"StartsSqueezed", Status::collapsed,
     [](Body& body, Scene& scene) {
       // A body given at a twenty-fifth of its rest areas, S/S0 = 0.04, with a pressure too weak to
       // tear it apart within the first eight steps.
       for (double& area : body.rest_area) area *= 25;
       scene.pressure = 0.01;
     }},
    {"ExplosiveDrag", Status::non_finite, [](Body&, Scene& scene) { scene.drag_normal = 1e30; }},
};

class FailureIn : public testing::TestWithParam<std::tuple<Precision, Failure>> {};

TEST_P(FailureIn, ABatchIsNamedAndDisturbsNobody) {
  const auto& [precision, failure] = GetParam();
  const LocomotionOptions options{.precision = precision, .threads = 2};
  Tasks all(64);
  const auto healthy = simulate(all.tasks, options);
  const std::size_t bad = 31;
  Scene scene = water_scene();
  scene.run_steps = 100;
  Body body = tests::blob_body(60, 77);
  failure.spoil(body, scene);
  all.tasks[bad] = {&body, &scene};
  const auto with_failure = simulate(all.tasks, options);
  for (std::size_t i = 0; i < all.tasks.size(); ++i) {
    if (i == bad) continue;
    EXPECT_TRUE(same_bits(healthy[i], with_failure[i])) << "task " << i;
  }
  const Outcome& outcome = with_failure[bad];
  EXPECT_EQ(name(outcome.status), name(failure.status));
  EXPECT_TRUE(is_failure(outcome.status));
  EXPECT_EQ(outcome.distance, 0);
  if (outcome.status >= Status::inverted) {
    EXPECT_GT(outcome.failed_step, 0);
    EXPECT_GE(outcome.failed_index, 0);
    EXPECT_EQ(outcome.failed_step, outcome.steps);
  }
  if (outcome.status == Status::step_too_large) {
    EXPECT_GT(outcome.failed_value, 0);
    EXPECT_LT(outcome.failed_value, scene.step);
  }
  if (outcome.status == Status::inverted) {
    EXPECT_LE(outcome.failed_value, 0);
  }
  if (outcome.status == Status::collapsed) {
    EXPECT_LT(outcome.failed_value, 0.05);
  }
  if (outcome.status == Status::speed) {
    EXPECT_GT(outcome.failed_value, 2.5);
  }
}

INSTANTIATE_TEST_SUITE_P(, Batch, testing::Values(Precision::float32, Precision::float64),
                         [](const auto& param) {
                           return param.param == Precision::float32 ? "Float32" : "Float64";
                         });
INSTANTIATE_TEST_SUITE_P(, FailureIn,
                         testing::Combine(testing::Values(Precision::float32, Precision::float64),
                                          testing::ValuesIn(failures)),
                         [](const auto& param) {
                           return (std::get<0>(param.param) == Precision::float32 ? "Float32"
                                                                                  : "Float64") +
                                  std::get<1>(param.param).name;
                         });

TEST(Settling, ThatTimesOutIsSaidAndItsDistanceCounts) {
  const Body body = tests::blob_body(40, 3);
  Scene scene = land_scene();
  scene.settle_max_steps = 10;
  scene.run_steps = 400;
  const LocomotionTask task{&body, &scene};
  const Outcome outcome = simulate({&task, 1}, {}).front();
  EXPECT_EQ(outcome.status, Status::not_settled);
  EXPECT_GT(outcome.distance, 0);
  EXPECT_DOUBLE_EQ(outcome.settle_time, 2.0);
}

TEST(StepLimit, SafeIsNeverAboveSharp) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Body body = tests::blob_body(50, seed, 0.25);
    for (const double damping : {0.0, 0.2, 0.4, 0.8}) {
      for (const Method method : {Method::drift_kick_drift, Method::symplectic_euler}) {
        const StepLimit limit = step_limit(body, water_scene(), damping, method);
        EXPECT_LE(limit.safe, limit.sharp * (1 + 1e-6)) << "seed " << seed;
        // Row sums of a lattice with six neighbours all around are 10, its largest eigenvalue 5.7,
        // and the limit is as the inverse of either where damping decides.
        EXPECT_GT(limit.safe, 0.45 * limit.sharp) << "seed " << seed;
      }
    }
  }
}

}  // namespace
}  // namespace metamorph::core
