#pragma once

// The fast simulator against the reference, node by node.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "metamorph/scene.h"
#include "metamorph/status.h"
#include "tests/physics.h"
#include "tests/simulators.h"
#include "tests/tolerance.h"

namespace metamorph::tests {

/// The largest root mean square distance of the nodes at any moment, and both outcomes.
struct Comparison {
  double distance = 0;
  core::Outcome reference, fast;
};

inline Comparison compare(const Simulator& reference, const Simulator& fast, const core::Body& body,
                          const core::Scene& scene, int every) {
  const Film expected = film(reference, body, scene, every);
  const Film actual = film(fast, body, scene, every);
  Comparison result{0, expected.outcome, actual.outcome};
  EXPECT_EQ(expected.pictures.size(), actual.pictures.size());
  for (std::size_t p = 0; p < std::min(expected.pictures.size(), actual.pictures.size()); ++p) {
    const auto& a = expected.pictures[p];
    const auto& b = actual.pictures[p];
    result.distance = std::max(result.distance, rms_distance(a.x, a.y, b.x, b.y));
  }
  return result;
}

/// Rounding of places of up to 8 d in every step, and what contact with the ground makes of it.
inline double rounding(const Simulator& fast, const core::Scene& scene,
                       const core::Outcome& outcome) {
  return tolerance::drift(fast.round_off, 8, static_cast<double>(outcome.steps)) *
         (scene.ground ? 10 : 1);
}

inline void expect_agreement(const Simulator& fast, const core::Body& body,
                             const core::Scene& scene,
                             const Simulator& reference = reference_simulator()) {
  SCOPED_TRACE(scene.name + ", " + std::to_string(body.node_count()) + " nodes, collision gap " +
               std::to_string(scene.collision_gap));
  const Comparison c = compare(reference, fast, body, scene, 100);
  ASSERT_EQ(c.reference.status, core::Status::ok);
  EXPECT_EQ(c.fast.status, core::Status::ok);
  EXPECT_TRUE(within(c.distance, rounding(fast, scene, c.reference)));
  EXPECT_TRUE(within(c.fast.distance - c.reference.distance, rounding(fast, scene, c.reference)));
  // The moment of rest may differ by a few steps where a speed of 0.01 is met closely.
  EXPECT_TRUE(within(c.fast.settle_time - c.reference.settle_time, 0.5));
  // The fast simulator sees the places in the middle of steps: half a step of at most 2 d per time
  // unit away from the reference's, over heights of triangles that are not below 0.4 d.
  EXPECT_TRUE(within(c.fast.min_area_ratio - c.reference.min_area_ratio, 0.05 * 2 / 0.4));
  EXPECT_TRUE(within(c.fast.max_speed / c.reference.max_speed - 1, 0.02));
  EXPECT_TRUE(within(c.fast.height - c.reference.height, rounding(fast, scene, c.reference)));
}

}  // namespace metamorph::tests
