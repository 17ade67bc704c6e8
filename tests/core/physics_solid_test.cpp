#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/body/outline_crossing.h"
#include "core/locomotion/solid_pairs.h"
#include "kernels/reference/self_collision.h"
#include "metamorph/scene.h"
#include "metamorph/status.h"
#include "tests/bodies.h"
#include "tests/physics.h"
#include "tests/simulators.h"
#include "tests/tolerance.h"

// Whole evaluations of bodies that are driven into themselves: solid things stay apart, and what
// does not is told.

namespace metamorph::tests {
namespace {

class Solid : public testing::TestWithParam<Simulator> {};

INSTANTIATE_TEST_SUITE_P(Simulators, Solid, testing::ValuesIn(simulators()),
                         testing::PrintToStringParamName());

/// The jaws on land under so much weight that they close at once, and bite on.
core::Scene biting_scene(double step) {
  core::Scene scene = lasting(core::land_scene(), 80);
  scene.gravity = 0.06;
  scene.step = step;
  scene.settle_step = step;
  scene.settle_max_steps = 500;
  scene.ramp_steps = 0;
  scene.amplitude = 0.3;
  return scene;
}

core::Body biting_body() {
  core::Body body = jaws_body();
  body.period.assign(body.period.size(), 10.0);
  return body;
}

/// The smallest gap in a film of a pair that is apart at rest, d.
double smallest_gap(const Film& film, const core::Body& body, const core::Scene& scene) {
  double smallest = 1;
  for (const core::SolidPair& pair : core::solid_pairs(body, scene)) {
    if (pair.threshold < scene.collision_gap) continue;
    for (const auto& picture : film.pictures)
      smallest = std::min(
          smallest,
          kernels::reference::closest_point(pair.node, pair.edge, picture.x, picture.y).gap);
  }
  return smallest;
}

TEST_P(Solid, JawsDrivenIntoEachOtherNeverCrossNorSink) {
  const core::Body body = biting_body();
  const auto outline = core::outline_of(body.triangles);
  for (const double step : {0.1, 0.2}) {
    const core::Scene scene = biting_scene(step);
    const Film bite = film(GetParam(), body, scene, 1);
    SCOPED_TRACE("step " + std::to_string(step));
    EXPECT_FALSE(core::is_failure(bite.outcome.status)) << core::name(bite.outcome.status);
    ASSERT_GT(bite.pictures.size(), 300u);
    double deepest = 0;
    int crossed = 0;
    for (const auto& picture : bite.pictures) {
      crossed += core::first_crossing(picture.x, picture.y, outline).has_value();
      deepest = std::min(deepest, *std::min_element(picture.y.begin(), picture.y.end()));
    }
    EXPECT_EQ(crossed, 0);
    // Places of up to 8 d and speeds of up to 4 round in the last drift.
    EXPECT_TRUE(within(deepest, 16 * GetParam().round_off));
    EXPECT_LT(smallest_gap(bite, body, scene), 0.15);  // they bit
  }
}

TEST_P(Solid, TrianglesWithoutPressureDoNotTurnOver) {
  // No triangle has pressure: nothing but its pairs holds one that is squeezed flat.
  const core::Body body = biting_body();
  core::Scene scene = biting_scene(0.1);
  scene.min_pressure_area = 10;
  const Film bite = film(GetParam(), body, scene, 1);
  EXPECT_FALSE(core::is_failure(bite.outcome.status)) << core::name(bite.outcome.status);
  double smallest = 1;
  for (const auto& picture : bite.pictures)
    for (const auto& [a, b, c] : body.triangles) {
      const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b),
                 k = static_cast<std::size_t>(c);
      const double area = ((picture.x[j] - picture.x[i]) * (picture.y[k] - picture.y[i]) -
                           (picture.x[k] - picture.x[i]) * (picture.y[j] - picture.y[i])) /
                          2;
      smallest = std::min(smallest, area);
    }
  EXPECT_GT(smallest, 0);
  EXPECT_LT(smallest, 0.1);  // of 0.43: they were squeezed
}

class FastSolid : public testing::TestWithParam<Simulator> {};

INSTANTIATE_TEST_SUITE_P(Simulators, FastSolid,
                         testing::Values(float64_simulator(), float32_simulator()),
                         testing::PrintToStringParamName());

TEST_P(FastSolid, AnOutlineThatCrossesItselfIsTold) {
  // Pairs with a gap of 0 have nothing to keep: they are let through, and looked at.
  const core::Body body = biting_body();
  core::Scene scene = biting_scene(0.1);
  scene.collision_gap = 0;
  const core::Outcome outcome = GetParam().run(body, scene, 1 << 30, [](const core::Frame&) {});
  EXPECT_EQ(outcome.status, core::Status::crossed) << core::name(outcome.status);
  EXPECT_EQ(outcome.distance, 0);
  EXPECT_EQ(outcome.mean_position[0], 0);
  EXPECT_EQ(outcome.failed_step, outcome.steps);
  // The edge, a spring of the outline, and a node of the outline.
  const auto outline = core::outline_of(body.triangles);
  ASSERT_GE(outcome.failed_index, 0);
  const auto [i, j] = body.springs[static_cast<std::size_t>(outcome.failed_index)];
  EXPECT_TRUE(
      std::binary_search(outline.begin(), outline.end(), std::array<core::Index, 2>{i, j}) ||
      std::binary_search(outline.begin(), outline.end(), std::array<core::Index, 2>{j, i}));
  EXPECT_TRUE(std::any_of(outline.begin(), outline.end(),
                          [&](const auto& edge) { return edge[0] == outcome.failed_value; }));
}

TEST_P(FastSolid, AnOutlineIsNotLookedAtWhereItMayCrossItself) {
  core::Scene scene = biting_scene(0.1);
  scene.self_collision = false;
  const core::Outcome outcome =
      GetParam().run(biting_body(), scene, 1 << 30, [](const core::Frame&) {});
  EXPECT_NE(outcome.status, core::Status::crossed);
}

TEST_P(FastSolid, ATriangleWithoutPressureThatTurnsOverIsTold) {
  const core::Body body = biting_body();
  core::Scene scene = biting_scene(0.1);
  scene.min_pressure_area = 10;
  scene.self_collision = false;
  const core::Outcome outcome = GetParam().run(body, scene, 1 << 30, [](const core::Frame&) {});
  EXPECT_EQ(outcome.status, core::Status::inverted) << core::name(outcome.status);
  EXPECT_EQ(outcome.distance, 0);
  EXPECT_GE(outcome.failed_index, 0);
  EXPECT_LT(outcome.failed_index, static_cast<int>(body.triangles.size()));
  EXPECT_LE(outcome.failed_value, 0);
  EXPECT_EQ(outcome.failed_step, outcome.steps);
}

TEST_P(FastSolid, AgreesWithTheReferenceWhileItBites) {
  // Long enough for the jaws to close and the stop to act; contact amplifies rounding, by less than
  // a thousand over this time.
  const core::Body body = biting_body();
  core::Scene scene = lasting(biting_scene(0.1), 20);
  scene.settle_max_steps = 100;
  const Film expected = film(reference_simulator(), body, scene, 10);
  const Film actual = film(GetParam(), body, scene, 10);
  ASSERT_EQ(expected.pictures.size(), actual.pictures.size());
  EXPECT_LT(smallest_gap(expected, body, scene), 0.25);
  const double rounding =
      1000 * tolerance::drift(GetParam().round_off, 8, static_cast<double>(expected.outcome.steps));
  for (std::size_t p = 0; p < expected.pictures.size(); ++p) {
    const auto &a = expected.pictures[p], &b = actual.pictures[p];
    EXPECT_TRUE(within(rms_distance(a.x, a.y, b.x, b.y), rounding)) << "picture " << p;
  }
}

}  // namespace
}  // namespace metamorph::tests
