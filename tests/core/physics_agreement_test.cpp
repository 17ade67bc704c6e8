#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "metamorph/scene.h"
#include "metamorph/status.h"
#include "tests/bodies.h"
#include "tests/core/agreement.h"
#include "tests/physics.h"
#include "tests/simulators.h"
#include "tests/tolerance.h"

// The fast simulator against the reference, node by node. The two share no code of physics.

namespace metamorph::tests {
namespace {

class Agreement : public testing::TestWithParam<Simulator> {};

INSTANTIATE_TEST_SUITE_P(Simulators, Agreement,
                         testing::Values(float64_simulator(), float32_simulator()),
                         testing::PrintToStringParamName());

TEST_P(Agreement, OfEveryNodeAtEveryMomentInWater) {
  const core::Scene scene = lasting(core::water_scene(), 200);
  for (const int nodes : {3, 8, 20, 60}) {
    const core::Body body = nodes == 3 ? triangle_body() : blob_body(nodes, 1);
    expect_agreement(GetParam(), body, scene);
    expect_agreement(GetParam(), body, crowded(scene));
  }
  expect_agreement(GetParam(), ring_body(2, 4), scene);
}

TEST_P(Agreement, OfEveryNodeAtEveryMomentOnLand) {
  const core::Scene scene = lasting(core::land_scene(), 100);
  for (const int nodes : {8, 20, 60}) {
    expect_agreement(GetParam(), blob_body(nodes, 1), scene);
    expect_agreement(GetParam(), blob_body(nodes, 1), crowded(scene));
  }
}

TEST_P(Agreement, OfEveryNodeAtEveryMomentOnTheSlope) {
  // Flat bodies, which do not roll: rolling amplifies rounding for a thousand time units.
  const core::Scene scene = lasting(core::slope_scene(), 100);
  expect_agreement(GetParam(), strip_body(12), scene);
  expect_agreement(GetParam(), strip_body(30), crowded(scene));
}

TEST_P(Agreement, OfABodyWithAPinch) {
  const core::Body body = pinched_body();
  ASSERT_TRUE(core::check(body).empty());
  expect_agreement(GetParam(), body, lasting(core::water_scene(), 100));
  expect_agreement(GetParam(), body, crowded(lasting(core::water_scene(), 100)));
  expect_agreement(GetParam(), body, lasting(core::land_scene(), 50));
}

TEST_P(Agreement, OnEveryCoefficient) {
  const core::Body body = blob_body(30, 3);
  const core::Scene water = lasting(core::water_scene(), 100);
  const core::Scene land = lasting(core::land_scene(), 50);
  const auto with = [&](core::Scene scene, auto member, auto value) {
    scene.*member = value;
    scene.name += ", coefficient " + std::to_string(value);
    expect_agreement(GetParam(), body, scene);
  };
  for (const core::Scene& scene : {water, land}) {
    with(scene, &core::Scene::stiffness, 1.3);
    with(scene, &core::Scene::damping, 0.25);
    with(scene, &core::Scene::pressure, 0.7);
    with(scene, &core::Scene::amplitude, 0.1);
    with(scene, &core::Scene::min_pressure_area, 0.42);  // leaves out some triangles
    with(scene, &core::Scene::ramp_steps, 0);
    with(scene, &core::Scene::ramp_steps, 50);
    with(scene, &core::Scene::step, 0.05);
    with(scene, &core::Scene::self_collision, false);
    with(crowded(scene), &core::Scene::collision_stiffness, 1.0);
    with(crowded(scene), &core::Scene::collision_least_gap, 0.5);
  }
  with(water, &core::Scene::drag, false);
  with(water, &core::Scene::drag_normal, 0.6);
  with(water, &core::Scene::drag_tangential, 0.3);
  with(land, &core::Scene::gravity, 0.03);
  with(land, &core::Scene::slope_degrees, -5.0);
  with(land, &core::Scene::friction, 0.0);
  with(land, &core::Scene::friction, 0.4);
  with(land, &core::Scene::settle_damping, 0.5);
  with(land, &core::Scene::settle_drag, 0.05);
  with(land, &core::Scene::settle_speed, 0.002);
  with(land, &core::Scene::settle_quiet_steps, 100);
}

TEST_P(Agreement, AfterManyPeriods) {
  // 2000 time units: the phase is reduced without loss, and water amplifies nothing.
  expect_agreement(GetParam(), blob_body(12, 2), lasting(core::water_scene(), 2000));
}

TEST_P(Agreement, OfOscillatorsOfOnePeriod) {
  // Blobs have periods of their own, which the tests above see; one period takes another way.
  core::Body body = blob_body(12, 2);
  std::fill(body.period.begin(), body.period.end(), 37.3);
  const core::Scene scene = lasting(core::water_scene(), 2000);
  expect_agreement(GetParam(), body, scene);
  // The smallest difference in one period leads back to the other way, to the same end.
  core::Body nearly = body;
  nearly.period.back() = std::nextafter(nearly.period.back(), 38.0);
  const core::Outcome one = GetParam().run(body, scene, 1 << 30, [](const core::Frame&) {});
  const core::Outcome own = GetParam().run(nearly, scene, 1 << 30, [](const core::Frame&) {});
  EXPECT_TRUE(within(one.distance - own.distance, 2 * rounding(GetParam(), scene, one)));
  EXPECT_NE(one.mean_position, own.mean_position);
  expect_agreement(GetParam(), body, crowded(lasting(core::land_scene(), 100)));
}

TEST_P(Agreement, OfSymplecticEuler) {
  const core::Precision precision =
      GetParam().round_off == round_off_32 ? core::Precision::float32 : core::Precision::float64;
  const Simulator fast =
      fast_simulator("fast Euler", GetParam().round_off, precision, core::Method::symplectic_euler);
  const Simulator reference = reference_simulator(core::ReferenceMethod::symplectic_euler);
  for (const core::Scene& scene : {core::water_scene(), core::land_scene()})
    expect_agreement(fast, blob_body(30, 2), lasting(scene, 50), reference);
}

TEST_P(Agreement, WithSelfCollisionOffWhereItMatters) {
  const core::Body body = blob_body(60, 1);
  core::Scene scene = crowded(lasting(core::water_scene(), 200));
  const double touching = core::simulate_reference(body, scene).distance;
  scene.self_collision = false;
  const double free = core::simulate_reference(body, scene).distance;
  EXPECT_GT(std::fabs(touching - free), 0.01);
  const core::Outcome fast = GetParam().run(body, scene, 1000, [](const core::Frame&) {});
  EXPECT_TRUE(within(fast.distance - free, rounding(GetParam(), scene, fast)));
}

TEST_P(Agreement, OnWhatFails) {
  // Drives that squeeze, tear and blow bodies up, from harmless to absurd. The fast simulator looks
  // at triangles in the middle of steps too, where forces are taken: it may see a collapse that the
  // reference sees later, as an inversion, but never misses what the reference sees.
  int failures = 0, runs = 0;
  for (const double amplitude : {0.1, 0.8, 1.5, 3.0, 10.0})
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
      core::Body body = blob_body(30, seed);
      for (double& period : body.period) period /= 10;
      core::Scene scene = core::water_scene();
      scene.amplitude = amplitude;
      const Comparison c = compare(reference_simulator(), GetParam(), body, scene, 1 << 30);
      ++runs;
      if (!core::is_failure(c.reference.status)) continue;
      ++failures;
      EXPECT_TRUE(core::is_failure(c.fast.status)) << "amplitude " << amplitude << " seed " << seed;
      EXPECT_LE(c.fast.failed_step, c.reference.failed_step)
          << "amplitude " << amplitude << " seed " << seed << " " << name(c.reference.status) << " "
          << name(c.fast.status);
      EXPECT_EQ(c.fast.distance, 0);
    }
  EXPECT_GT(failures, 3);
  EXPECT_LT(failures, runs);
}

}  // namespace
}  // namespace metamorph::tests
