#include "metamorph/automatic_step.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "core/reference/stability.h"
#include "metamorph/locomotion.h"
#include "metamorph/reference.h"
#include "metamorph/stability.h"
#include "tests/bodies.h"
#include "tests/outcomes.h"

namespace metamorph::tests {
namespace {

using core::Method;
using core::ReferenceMethod;
using core::Scene;
using core::StepUse;

std::vector<core::Body> bodies() {
  std::vector<core::Body> all = {triangle_body(), hexagon_body(),  strip_body(12),
                                 disc_body(37),   ring_body(2, 4), pinched_body()};
  for (std::uint64_t seed = 1; seed <= 2; ++seed) all.push_back(blob_body(30, seed));
  return all;
}

Scene automatic(Scene scene) {
  scene.step = scene.settle_step = core::automatic_step;
  return scene;
}

ReferenceMethod reference(Method method) {
  return method == Method::drift_kick_drift ? ReferenceMethod::drift_kick_drift
                                            : ReferenceMethod::symplectic_euler;
}

/// The whole spectrum's limit, found independently of what chooses the steps.
double limit_of(const core::Body& body, const Scene& scene, Method method, bool settling) {
  const core::StepPhase phase = core::step_phase(scene, method, settling);
  return core::linear_step_limit(body, scene, phase.damping, reference(phase.method));
}

// A step that divides the duration: duration / h is a whole number but for the rounding of h, and
// one step fewer would be too few.
void expect_divides(double duration, double h, double largest) {
  const double steps = std::round(duration / h);
  EXPECT_NEAR(duration / h, steps, 4 * 0x1p-53 * steps);
  EXPECT_LE(h, largest * (1 + 4 * 0x1p-53));
  EXPECT_GT(duration / std::max(steps - 1, 1e-9), largest);
}

TEST(AutomaticStep, KeepsTheMarginAndMeetsTheDuration) {
  for (const core::Body& body : bodies()) {
    for (const Method method : {Method::drift_kick_drift, Method::symplectic_euler}) {
      for (Scene scene : {core::water_scene(), core::land_scene(), core::slope_scene()}) {
        scene = automatic(scene);
        for (const auto& [stiffness, damping, run_steps] :
             {std::tuple{1.0, 0.4, 3000}, {1.0, 0.0, 17}, {30.0, 0.4, 1}, {0.2, 2.0, 999}}) {
          scene.stiffness = stiffness;
          scene.damping = damping;
          scene.run_steps = run_steps;
          const Scene chosen = core::with_chosen_steps(body, scene, method);
          const double margin = scene.ground ? core::land_margin : core::water_margin;
          EXPECT_LE(chosen.step, margin * limit_of(body, scene, method, false));
          EXPECT_LE(chosen.settle_step,
                    core::settling_margin * limit_of(body, scene, method, true));
          double safe = core::safe_step_limit(body, scene, damping, method);
          // A pair pushed apart by k_s = 4 allows h^2 8 = 4.
          safe = std::min(safe, std::sqrt(0.5));
          expect_divides(run_steps * core::paper_step, chosen.step,
                         std::min(margin * safe, 40.0 / 20));
          EXPECT_EQ(core::assess_steps(body, chosen, method).use, StepUse::safe);
        }
      }
    }
  }
}

TEST(AutomaticStep, LeavesFixedStepsAlone) {
  const core::Body body = disc_body(19);
  Scene scene = core::land_scene();
  EXPECT_FALSE(core::chooses_steps(scene));
  const auto same = core::with_chosen_steps(body, scene, Method::drift_kick_drift);
  EXPECT_EQ(same.step, scene.step);
  EXPECT_EQ(same.settle_step, scene.settle_step);
  scene.settle_step = core::automatic_step;
  EXPECT_TRUE(core::chooses_steps(scene));
  const auto half = core::with_chosen_steps(body, scene, Method::drift_kick_drift);
  EXPECT_EQ(half.step, scene.step);
  EXPECT_GT(half.settle_step, 0);
}

// What the body's stiffness does not limit: a soft body by its oscillators (the fastest has a
// period of 40), stiff self-collision by itself: h^2 k = 4.
TEST(AutomaticStep, IsBoundByWhatElseTheSceneHolds) {
  const core::Body body = disc_body(19);
  Scene soft = automatic(core::water_scene());
  soft.stiffness = soft.pressure = soft.damping = 1e-9;
  soft.self_collision = false;
  EXPECT_EQ(core::with_chosen_steps(body, soft, Method::drift_kick_drift).step, 2.0);
  Scene crowded = automatic(core::water_scene());
  crowded.collision_stiffness = 5e3;  // a pair: h^2 1e4 = 4
  expect_divides(600, core::with_chosen_steps(body, crowded, Method::drift_kick_drift).step,
                 core::water_margin * 0.02);
}

// The same bits as the chosen step given as a fixed one; alone, in a batch, on two threads.
TEST(AutomaticStep, IsAFixedStepOnceChosen) {
  const std::vector<core::Body> all = bodies();
  for (Scene scene : {core::water_scene(), core::land_scene()}) {
    scene.run_steps = 100;
    scene.settle_quiet_steps = 20;
    scene.settle_max_steps = 100;
    const Scene left_open = automatic(scene);
    std::vector<core::LocomotionTask> tasks;
    for (const core::Body& body : all) tasks.push_back({&body, &left_open});
    const auto batch =
        core::simulate(tasks, {core::Precision::float32, Method::drift_kick_drift, 2});
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Scene chosen = core::with_chosen_steps(all[i], left_open, Method::drift_kick_drift);
      const core::LocomotionTask task = {&all[i], &chosen};
      const auto fixed =
          core::simulate({&task, 1}, {core::Precision::float32, Method::drift_kick_drift, 1});
      EXPECT_TRUE(same_bits(batch[i], fixed.front())) << i;
      EXPECT_EQ(batch[i].step, chosen.step);
      EXPECT_EQ(batch[i].settle_step, scene.ground ? chosen.settle_step : 0);
      EXPECT_FALSE(batch[i].near_step_limit);
      const core::Outcome reference_given = core::simulate_reference(all[i], chosen);
      EXPECT_TRUE(same_bits(core::simulate_reference(all[i], left_open), reference_given));
    }
  }
}

// Order 2: the error of the chosen step against that of 0.05 is as (h / 0.05)^2, with a quarter on
// top for what is not yet of that order; the truth is RK4 at 0.05, whose error is of order 4.
TEST(AutomaticStep, IsAsAccurateAsItsSize) {
  Scene scene = core::water_scene();
  scene.run_steps = 1000;
  for (const core::Body& body : {disc_body(37), strip_body(12)}) {
    const double truth =
        core::simulate_reference(body, scene, {ReferenceMethod::runge_kutta_4, 0.05, 1, {}})
            .distance;
    const double fine =
        core::simulate_reference(body, scene, {ReferenceMethod::drift_kick_drift, 0.05, 1, {}})
            .distance;
    const core::Outcome chosen = core::simulate_reference(body, automatic(scene));
    const double ratio = chosen.step / 0.05;
    EXPECT_LE(std::abs(chosen.distance - truth), 1.25 * ratio * ratio * std::abs(fine - truth))
        << "step " << chosen.step << " distance " << truth;
  }
}

// On both sides of the margin and of the limit, 5 % away: the limit is known to 2 %.
TEST(AssessSteps, TellsCloseFromSafeAndTooLarge) {
  for (const core::Body& body : bodies()) {
    for (const Method method : {Method::drift_kick_drift, Method::symplectic_euler}) {
      for (const bool settling : {false, true}) {
        for (Scene scene : {core::water_scene(), core::land_scene()}) {
          if (settling && !scene.ground) continue;
          const double margin = core::step_phase(scene, method, settling).margin;
          const double limit = limit_of(body, scene, method, settling);
          const auto assess = [&](double share) {
            (settling ? scene.settle_step : scene.step) = share * limit;
            (settling ? scene.step : scene.settle_step) = 1e-3;
            return core::assess_steps(body, scene, method);
          };
          EXPECT_EQ(assess(0.3 * margin).use, StepUse::safe);
          EXPECT_EQ(assess(0.95 * margin).use, StepUse::safe);
          EXPECT_EQ(assess(1.05 * margin).use, StepUse::close);
          EXPECT_EQ(assess(1.05 * margin).settling, settling);
          EXPECT_EQ(assess(0.95).use, StepUse::close);
          EXPECT_EQ(assess(1.05).use, StepUse::too_large);
          EXPECT_EQ(assess(5).use, StepUse::too_large);
          EXPECT_EQ(assess(5).settling, settling);
        }
      }
    }
  }
}

TEST(AutomaticStep, IsNeverLongerThanWhatItDivides) {
  // Nothing swings: any step would do.
  Scene scene = automatic(core::land_scene());
  scene.stiffness = scene.damping = scene.settle_damping = scene.pressure = 0;
  scene.collision_stiffness = 0;
  scene.run_steps = 1;
  const Scene chosen = core::with_chosen_steps(disc_body(13), scene, Method::drift_kick_drift);
  EXPECT_EQ(chosen.step, core::paper_step);
  EXPECT_EQ(chosen.settle_step, scene.settle_max_steps * core::paper_step);
}

TEST(AssessSteps, ReachesTheOutcome) {
  const core::Body body = disc_body(37);
  Scene scene = core::water_scene();
  scene.run_steps = 10;
  const double limit = limit_of(body, scene, Method::drift_kick_drift, false);
  const auto outcome = [&](double share) {
    scene.step = share * limit;
    const core::LocomotionTask task = {&body, &scene};
    return core::simulate({&task, 1}, {}).front();
  };
  EXPECT_FALSE(outcome(0.85).near_step_limit);
  EXPECT_TRUE(outcome(0.95).near_step_limit);
  EXPECT_EQ(outcome(0.95).status, core::Status::ok);
  EXPECT_EQ(outcome(1.05).status, core::Status::step_too_large);
  EXPECT_FALSE(outcome(1.05).near_step_limit);
  EXPECT_NEAR(outcome(1.05).failed_value, limit, 0.03 * limit);
}

}  // namespace
}  // namespace metamorph::tests
