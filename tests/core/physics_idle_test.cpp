#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "metamorph/random.h"
#include "metamorph/scene.h"
#include "metamorph/status.h"
#include "tests/bodies.h"
#include "tests/physics.h"
#include "tests/simulators.h"
#include "tests/tolerance.h"

// Bodies that have no means to travel do not: without actuation, without surroundings, or with a
// motion that is its own mirror image. Whole evaluations, by every simulator.

namespace metamorph::tests {
namespace {

class Idle : public testing::TestWithParam<Simulator> {
 protected:
  core::Outcome run(const core::Body& body, const core::Scene& scene) const {
    const core::Outcome outcome = GetParam().run(body, scene, 1 << 30, [](const core::Frame&) {});
    EXPECT_FALSE(core::is_failure(outcome.status)) << core::name(outcome.status);
    return outcome;
  }
  /// Rounding of places of up to 8 d in every step.
  double rounding(const core::Outcome& outcome) const {
    return tolerance::drift(GetParam().round_off, 8, static_cast<double>(outcome.steps));
  }
};

INSTANTIATE_TEST_SUITE_P(Simulators, Idle, testing::ValuesIn(simulators()),
                         testing::PrintToStringParamName());

/// All oscillators in step: the body only breathes.
core::Body in_step(core::Body body) {
  body.period.assign(body.period.size(), 40.0);
  body.phase.assign(body.phase.size(), 0.0);
  return body;
}

/// A row of n nodes, on it one of n - 1: its own mirror image.
core::Body trapezoid(int n) {
  std::set<LatticePoint> points;
  for (int u = 0; u < n; ++u) points.insert({u, 0});
  for (int u = 0; u < n - 1; ++u) points.insert({u, 1});
  return lattice_body(points);
}

/// Every node moved by up to 0.05 d. A perfect lattice body can stand where it should buckle, until
/// rounding tips it over.
core::Body imperfect(core::Body body) {
  evolve::RandomStream random(evolve::Purpose::test, 3, 0, 0);
  for (auto* coordinates : {&body.x, &body.y})
    for (double& value : *coordinates) value += 0.05 * (2 * random.uniform() - 1);
  core::set_rest_from_nodes(body);
  return body;
}

std::vector<std::pair<std::string, core::Body>> odd_bodies() {
  return {{"blob", blob_body(40, 4)},
          {"pinched", imperfect(pinched_body())},
          {"ring", imperfect(ring_body(2, 4))},
          {"jaws", imperfect(jaws_body())}};
}

TEST_P(Idle, WithoutActuationNothingSwims) {
  for (const auto& [name, body] : odd_bodies())
    for (core::Scene scene : {core::water_scene(), crowded(core::water_scene())}) {
      scene.amplitude = 0;
      const core::Outcome outcome = run(body, scene);
      // What does not move rounds alike in every step.
      EXPECT_TRUE(within(outcome.distance, tolerance::growth(GetParam().round_off, 8,
                                                             static_cast<double>(outcome.steps))))
          << name;
    }
}

TEST_P(Idle, WithoutActuationNothingWalks) {
  // Settled to a rest a hundred times as still as the scenes ask for, what still creeps is slower
  // than that: over 600 time units 0.06 d.
  for (const core::Scene& land : {core::land_scene(), crowded(core::land_scene())})
    for (const auto& [name, body] : odd_bodies()) {
      core::Scene scene = land;
      scene.amplitude = 0;
      scene.settle_speed = 1e-4;
      const core::Outcome outcome = run(body, scene);
      EXPECT_TRUE(within(outcome.distance, scene.settle_speed * 600)) << name;
    }
}

TEST_P(Idle, WithoutSurroundingsNothingMovesItself) {
  // Momentum that rounding makes is carried through the whole run: 600 time units.
  for (const auto& [name, body] : odd_bodies())
    for (core::Scene scene : {core::water_scene(), crowded(core::water_scene())}) {
      scene.drag = false;
      const core::Outcome outcome = run(body, scene);
      const double speed = tolerance::drift(GetParam().round_off, 0.2 * body.node_count(),
                                            static_cast<double>(outcome.steps)) /
                           body.node_count();
      EXPECT_TRUE(within(outcome.distance, speed * 600)) << name;
    }
}

TEST_P(Idle, WhatBreathesAlikeOnAllSidesDoesNotTravel) {
  for (const int nodes : {7, 19, 61}) {
    const core::Outcome outcome = run(in_step(disc_body(nodes)), core::water_scene());
    EXPECT_TRUE(within(outcome.distance, rounding(outcome))) << nodes << " nodes";
  }
  const core::Outcome ring = run(in_step(ring_body(2, 4)), core::water_scene());
  EXPECT_TRUE(within(ring.distance, rounding(ring)));
}

TEST_P(Idle, WhatIsItsOwnMirrorImageWalksNeitherWay) {
  for (const int n : {4, 7}) {
    const core::Outcome outcome = run(in_step(trapezoid(n)), core::land_scene());
    EXPECT_TRUE(within(outcome.distance, 10 * rounding(outcome))) << n << " nodes below";
  }
}

}  // namespace
}  // namespace metamorph::tests
