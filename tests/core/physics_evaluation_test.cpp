#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "metamorph/scene.h"
#include "metamorph/status.h"
#include "tests/bodies.h"
#include "tests/outcomes.h"
#include "tests/physics.h"
#include "tests/simulators.h"
#include "tests/tolerance.h"

// Whole evaluations against theory, and outcomes against what was seen.

namespace metamorph::tests {
namespace {

class Evaluation : public testing::TestWithParam<Simulator> {};

INSTANTIATE_TEST_SUITE_P(Simulators, Evaluation, testing::ValuesIn(simulators()),
                         testing::PrintToStringParamName());

double lowest(const std::vector<double>& values) {
  return *std::min_element(values.begin(), values.end());
}

TEST_P(Evaluation, ABodyRestsWhereNothingDrivesIt) {
  core::Scene scene = lasting(core::water_scene(), 200);
  scene.amplitude = 0;
  const core::Body body = blob_body(60, 1);
  const Film result = film(GetParam(), body, scene, 100);
  double moved = 0;
  for (const auto& picture : result.pictures)
    moved = std::max(moved, rms_distance(picture.x, picture.y, body.x, body.y));
  // Places, rest lengths and areas are rounded at sizes of up to 16 d. What a node sums is rounded
  // too: some 18 terms (a spring and two sides of a triangle for each of six neighbours) of size
  // 1/2, always alike while nothing moves; the body falls freely under what is left of them.
  const double nodes = 60, push = GetParam().round_off / 2 * std::sqrt(18 * nodes);
  const double fall = push / nodes * 200 * 200 / 2;
  EXPECT_TRUE(within(moved, 16 * 8 * GetParam().round_off + fall));
}

TEST_P(Evaluation, WithoutSurroundingsABodyCannotMoveItself) {
  core::Scene scene = lasting(core::water_scene(), 400);
  scene.drag = false;
  const core::Body body = blob_body(40, 4);
  const Film result = film(GetParam(), body, scene, 20);
  const double steps = 400 / scene.step;
  // Per step 40 nodes round speeds of up to 0.2 d per time unit; and the forces that make them.
  const double momentum = tolerance::drift(GetParam().round_off, 0.2 * 40, steps);
  double largest = 0, turning = 0;
  for (const auto& picture : result.pictures) {
    largest = std::max({largest, std::fabs(mean(picture.vx)), std::fabs(mean(picture.vy))});
    double angular = 0;
    for (std::size_t i = 0; i < picture.x.size(); ++i)
      angular += picture.x[i] * picture.vy[i] - picture.y[i] * picture.vx[i];
    turning = std::max(turning, std::fabs(angular));
  }
  EXPECT_TRUE(within(largest, momentum / 40));
  EXPECT_TRUE(within(turning, 8 * momentum));  // places of up to 8 d
  EXPECT_TRUE(within(result.outcome.distance, momentum / 40 * 400));
  double active = 0;
  for (const double v : result.pictures.back().vx) active = std::max(active, std::fabs(v));
  EXPECT_GT(active, 0.01);
}

TEST_P(Evaluation, ABodyComesToRestOnTheGroundAndNeverSinksIntoIt) {
  core::Scene scene = lasting(core::land_scene(), 400);
  scene.amplitude = 0;
  for (const int nodes : {12, 40}) {  // flat ones: a disc would roll
    const Film result = film(GetParam(), strip_body(nodes), scene, 20);
    EXPECT_EQ(result.outcome.status, core::Status::ok);
    // Ground stops a drift where it reaches 0: rounding of the places and speeds of that step.
    double deepest = 0;
    for (const auto& picture : result.pictures) deepest = std::min(deepest, lowest(picture.y));
    EXPECT_TRUE(within(deepest, 8 * GetParam().round_off));
    const auto& last = result.pictures.back();
    double resting = 0, fastest = 0;
    for (const double y : last.y) resting += y < 8 * GetParam().round_off;
    for (const double v : last.vy) fastest = std::max(fastest, std::fabs(v));
    EXPECT_GE(resting, 2);
    EXPECT_TRUE(within(fastest, 1e-7 + 64 * GetParam().round_off));
  }
}

/// A brick that cannot topple: a flat strip.
core::Body brick() { return strip_body(12); }

/// Slides for 400 time units from a standstill on the slope. The contact's oscillations fade within
/// the first 200.
Film slide(const Simulator& simulator, double mu) {
  core::Scene scene = lasting(core::slope_scene(), 400);
  scene.amplitude = 0;
  scene.settle_quiet_steps = 0;
  scene.step = 0.1;
  scene.friction = mu;
  return film(simulator, brick(), scene, 2000);
}

TEST_P(Evaluation, ABrickSlidesDownASlopeOf17DegreesBelowItsTangent) {
  // tan 17 degrees = 0.3057. Sliding: a = g (sin - mu cos), measured between t = 200 and 400.
  const double angle = 17 * std::numbers::pi / 180;
  for (const double mu : {0.0, 0.2, 0.30}) {
    const Film result = slide(GetParam(), mu);
    ASSERT_EQ(result.pictures.size(), 3u);
    const double a = -(mean(result.pictures[2].vx) - mean(result.pictures[1].vx)) / 200;
    const double g = 0.02;
    const double expected = g * (std::sin(angle) - mu * std::cos(angle));
    // 2e-4 g near the threshold (NUMERICS section 8, test 13), and the speeds' own rounding.
    EXPECT_TRUE(within(a - expected, 2e-4 * g + 64 * GetParam().round_off * g)) << "mu " << mu;
  }
}

TEST_P(Evaluation, ABrickSticksOnASlopeOf17DegreesAboveItsTangent) {
  for (const double mu : {0.31, 0.8}) {
    const Film result = slide(GetParam(), mu);
    ASSERT_EQ(result.pictures.size(), 3u);
    // Its last oscillations have faded and nothing creeps. Places of up to 8 d round; springs make
    // forces and speeds of the roundings of a node and its neighbours.
    const double rest = 1e-7 + 8 * 8 * GetParam().round_off;
    double fastest = 0;
    for (const double v : result.pictures[2].vx) fastest = std::max(fastest, std::fabs(v));
    EXPECT_TRUE(within(fastest, rest)) << "mu " << mu;
    EXPECT_TRUE(within(mean(result.pictures[2].x) - mean(result.pictures[1].x), 200 * 1e-7))
        << "mu " << mu;
  }
}

TEST_P(Evaluation, ErrorsFallWithTheSquareOfTheStepInWater) {
  // Drift-kick-drift against RK4 at a tenth of the step; the steps' own rounding on top.
  const core::Body body = strip_body(16);
  core::Scene scene = lasting(core::water_scene(), 80);
  core::ReferenceOptions exact;
  exact.method = core::ReferenceMethod::runge_kutta_4;
  exact.step = 0.02;
  const core::Outcome truth = core::simulate_reference(body, scene, exact);
  const auto error = [&](double h) {
    scene.step = h;
    const core::Outcome outcome = GetParam().run(body, scene, 1000, [](const core::Frame&) {});
    return std::hypot(outcome.mean_position[0] - truth.mean_position[0],
                      outcome.mean_position[1] - truth.mean_position[1]);
  };
  const double rounding = tolerance::drift(GetParam().round_off, 8, 80 / 0.05);
  const double coarse = error(0.2), fine = error(0.05);
  EXPECT_TRUE(within(fine, coarse / 16 * 1.25 + rounding));
  EXPECT_LT(coarse, 0.01 * truth.distance + rounding);
}

TEST_P(Evaluation, OutcomesSayWhatWasSeen) {
  const core::Body body = blob_body(50, 7);
  for (core::Scene scene :
       {core::water_scene(), core::land_scene(), core::land_right_scene(), core::slope_scene()}) {
    scene = lasting(scene, 60);
    const int steps = static_cast<int>(std::lround(60 / scene.step));
    const Film result = film(GetParam(), body, scene, steps);
    const core::Outcome& outcome = result.outcome;
    ASSERT_EQ(outcome.status, core::Status::ok) << scene.name;
    ASSERT_EQ(result.pictures.size(), 2u);
    const auto& first = result.pictures[0];
    const auto& last = result.pictures[1];
    EXPECT_EQ(first.time, 0);
    EXPECT_TRUE(within(last.time / 60 - 1, tolerance::sum(round_off_64, 4)));
    const double dx = mean(last.x) - mean(first.x), dy = mean(last.y) - mean(first.y);
    const double rounding = 64 * GetParam().round_off;
    EXPECT_TRUE(within(outcome.mean_position[0] - dx, rounding));
    EXPECT_TRUE(within(
        outcome.mean_position[1] - (core::measures_height(scene) ? mean(last.y) : dy), rounding));
    const double distance = scene.name == "water"  ? std::hypot(dx, dy)
                            : scene.name == "land" ? std::fabs(dx)
                                                   : std::max(dx, 0.0);
    EXPECT_TRUE(within(outcome.distance - distance, rounding)) << scene.name;
    EXPECT_EQ(outcome.cells, body.node_count());
    EXPECT_EQ(outcome.springs, static_cast<int>(body.springs.size()));
    EXPECT_EQ(outcome.triangles, static_cast<int>(body.triangles.size()));
    EXPECT_EQ(outcome.steps, std::lround(outcome.settle_time / scene.settle_step) + steps);
    if (core::settles(scene)) {
      EXPECT_GE(outcome.settle_time, scene.settle_quiet_steps * core::paper_step);
    } else {
      EXPECT_EQ(outcome.settle_time, 0);
      EXPECT_TRUE(within(rms_distance(first.x, first.y, body.x, body.y), 8 * GetParam().round_off));
    }
    EXPECT_GT(outcome.min_area_ratio, 0.05);
    EXPECT_LT(outcome.min_area_ratio, 1);
    EXPECT_GT(outcome.max_speed, 0);
    EXPECT_EQ(outcome.failed_step, -1);
    EXPECT_EQ(outcome.failed_index, -1);
  }
}

TEST_P(Evaluation, StartsWithTheLowestNodeOnTheGround) {
  core::Scene scene = lasting(core::land_scene(), 0.2);
  scene.settle_quiet_steps = 0;
  core::Body body = disc_body(13);
  for (double& y : body.y) y += 5;
  const Film result = film(GetParam(), body, scene, 1);
  EXPECT_TRUE(within(lowest(result.pictures[0].y), 8 * GetParam().round_off));
}

TEST_P(Evaluation, ObservingChangesNoBit) {
  const core::Body body = blob_body(30, 8);
  const core::Scene scene = lasting(core::land_scene(), 60);
  const core::Outcome rarely = GetParam().run(body, scene, 1 << 30, [](const core::Frame&) {});
  const core::Outcome often = GetParam().run(body, scene, 1, [](const core::Frame&) {});
  EXPECT_TRUE(same_bits(rarely, often));
}

TEST_P(Evaluation, TimesOutWhereNothingComesToRest) {
  core::Scene scene = lasting(core::land_scene(), 30);
  scene.settle_speed = 1e-300;
  scene.settle_max_steps = 300;
  const core::Outcome outcome =
      GetParam().run(disc_body(13), scene, 100, [](const core::Frame&) {});
  EXPECT_EQ(outcome.status, core::Status::not_settled);
  EXPECT_DOUBLE_EQ(outcome.settle_time, 60);
  EXPECT_EQ(outcome.steps, 300 + 200);  // 60 time units of 0.2, then 30 of 0.15
}

TEST_P(Evaluation, AFailureIsDataWithDistanceZero) {
  core::Body body = blob_body(30, 9);
  for (double& period : body.period) period = 5;
  core::Scene scene = core::water_scene();
  scene.amplitude = 3;  // rest lengths of less than nothing
  scene.ramp_steps = 0;
  const core::Outcome outcome = GetParam().run(body, scene, 100, [](const core::Frame&) {});
  EXPECT_TRUE(core::is_failure(outcome.status)) << core::name(outcome.status);
  EXPECT_EQ(outcome.distance, 0);
  EXPECT_EQ(outcome.mean_position[0], 0);
  EXPECT_GT(outcome.failed_step, 0);
  EXPECT_EQ(outcome.failed_step % 8, 0);
  EXPECT_GE(outcome.failed_index, 0);
}

TEST_P(Evaluation, BadBodiesAreRefusedBeforeTheFirstStep) {
  core::Body body = blob_body(30, 9);
  body.period[3] = std::numeric_limits<double>::quiet_NaN();
  const auto never = [](const core::Frame&) { FAIL(); };
  const core::Outcome outcome = GetParam().run(body, core::water_scene(), 1, never);
  EXPECT_EQ(outcome.status, core::Status::bad_input);
  EXPECT_EQ(outcome.steps, 0);
  EXPECT_EQ(GetParam().run({}, core::water_scene(), 1, never).status, core::Status::empty);
}

TEST_P(Evaluation, StepsThatCannotBeTakenAreRefusedBeforeTheFirst) {
  const auto never = [](const core::Frame&) { FAIL(); };
  const auto outcome = [&](const core::Body& body, const core::Scene& scene) {
    const core::Outcome result = GetParam().run(body, scene, 1, never);
    EXPECT_EQ(result.steps, 0);
    EXPECT_EQ(result.failed_step, 0);
    EXPECT_EQ(result.distance, 0);
    return result;
  };
  const auto expect_too_large = [&](const core::Outcome& found, double largest, int node) {
    EXPECT_EQ(found.status, core::Status::step_too_large);
    EXPECT_EQ(found.failed_value, largest);
    EXPECT_EQ(found.failed_index, node);
  };
  core::Body body = blob_body(30, 9);
  core::Scene scene = core::water_scene();
  // Longer than the run.
  scene.run_steps = 1;
  scene.step = 0.21;
  expect_too_large(outcome(body, scene), 0.2, -1);
  scene.step = 5;
  expect_too_large(outcome(body, scene), 0.2, -1);
  // More than a quarter of a period.
  body.period[7] = 0.6;
  body.period[9] = 0.7;
  scene = core::land_scene();
  scene.step = 0.151;
  expect_too_large(outcome(body, scene), 0.15, 7);
  scene.run_steps = 1;
  scene.step = 0.3;
  expect_too_large(outcome(body, scene), 0.15, 7);
  body.period[7] = 2;
  body.period[9] = 2;
  expect_too_large(outcome(body, scene), 0.2, -1);
  // No step at all, and more than can be counted.
  for (const double step : {-0.1, std::numeric_limits<double>::quiet_NaN(),
                            std::numeric_limits<double>::infinity(), 1e-300}) {
    scene = core::land_scene();
    scene.step = step;
    EXPECT_EQ(outcome(body, scene).status, core::Status::bad_input) << step;
    scene.step = 0.1;
    scene.settle_step = step;
    EXPECT_EQ(outcome(body, scene).status, core::Status::bad_input) << step;
  }
}

TEST_P(Evaluation, TheLargestStepsAllowedAreTaken) {
  core::Body body = blob_body(30, 9);
  std::fill(body.period.begin(), body.period.end(), 0.6);
  core::Scene scene = core::water_scene();
  scene.amplitude = 0.01;
  scene.step = 0.6 / 4;
  scene.run_steps = 3;
  EXPECT_EQ(GetParam().run(body, scene, 1, {}).steps, 4);
  for (const int steps : {1, 2, 3, 6, 7}) {
    body.period.assign(body.period.size(), 40);
    scene.stiffness = scene.pressure = 1e-3;  // bears a step of any such length
    scene.drag = scene.self_collision = false;
    scene.damping = 0;
    scene.run_steps = steps;
    scene.step = 0.2 * steps;
    EXPECT_EQ(GetParam().run(body, scene, 1, {}).steps, 1) << steps;
  }
}

TEST_P(Evaluation, AShortPeriodAndARunOfOneStepLeaveStepsToTake) {
  core::Body body = blob_body(30, 9);
  body.period[4] = core::smallest_period;
  core::Scene scene = core::water_scene();
  scene.amplitude = 0;
  scene.step = core::automatic_step;
  scene.run_steps = 1;
  EXPECT_EQ(GetParam().run(body, scene, 1, {}).steps, 4000);  // twenty a period
  body.period[4] = 1e-12;
  EXPECT_EQ(GetParam().run(body, scene, 1, {}).status, core::Status::bad_input);
}

}  // namespace
}  // namespace metamorph::tests
