#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "metamorph/reference.h"
#include "metamorph/scene.h"
#include "metamorph/status.h"
#include "tests/bodies.h"
#include "tests/physics.h"
#include "tests/simulators.h"
#include "tests/tolerance.h"

namespace metamorph::tests {
namespace {

/// NUMERICS section 8, test 27: what the default method is chosen for. A leapfrog computes an
/// oscillation of frequency w with one that is wrong by (w h)^2/24 of itself; the frequencies that
/// carry a gait are below that of a pair, sqrt(2 k/m), and so are the relative errors of the ways.
TEST(WorkPrecision, DriftKickDriftInFloatMeetsItsErrorAtItsPrice) {
  constexpr int bodies = 48;
  for (const auto& [damping, step] : {std::pair{0.2, 0.4}, std::pair{0.4, 0.2}}) {
    core::Scene scene = lasting(core::water_scene(), 400);
    scene.damping = damping;
    scene.step = step;
    core::ReferenceOptions exact;
    exact.method = core::ReferenceMethod::runge_kutta_4;
    exact.step = 0.1;
    std::vector<double> truth, distance, error;
    for (std::uint64_t seed = 1; seed <= bodies; ++seed) {
      const core::Body body = blob_body(24 + 3 * static_cast<int>(seed) / 2, seed);
      truth.push_back(core::simulate_reference(body, scene, exact).distance);
      const core::Outcome outcome =
          float32_simulator().run(body, scene, 1 << 30, [](const core::Frame&) {});
      EXPECT_EQ(outcome.status, core::Status::ok) << "seed " << seed;
      EXPECT_EQ(outcome.steps, std::lround(400 / step));  // one evaluation each
      distance.push_back(outcome.distance);
      error.push_back(std::fabs(distance.back() / truth.back() - 1));
    }
    std::sort(error.begin(), error.end());
    const int swapped = swapped_pairs(distance, truth);
    const std::string measured =
        "damping " + std::to_string(damping) + ", step " + std::to_string(step) +
        ": relative error median " + std::to_string(error[bodies / 2]) + ", 90 % " +
        std::to_string(error[bodies * 9 / 10]) + ", swapped pairs " + std::to_string(swapped);
    EXPECT_TRUE(within(error[bodies / 2], 2 * step * step / 24)) << measured;
    // tau = 1 - 2 swapped / pairs > 0.99.
    EXPECT_TRUE(within(swapped, 0.005 * bodies * (bodies - 1) / 2)) << measured;
    RecordProperty("step_" + std::to_string(step), measured);
  }
}

}  // namespace
}  // namespace metamorph::tests
