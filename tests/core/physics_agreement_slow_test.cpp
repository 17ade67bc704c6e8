#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "metamorph/reference.h"
#include "tests/bodies.h"
#include "tests/core/agreement.h"

namespace metamorph::tests {
namespace {

class LargeAgreement : public testing::TestWithParam<Simulator> {};

INSTANTIATE_TEST_SUITE_P(Simulators, LargeAgreement,
                         testing::Values(float64_simulator(), float32_simulator()),
                         testing::PrintToStringParamName());

TEST_P(LargeAgreement, OfLargeBodies) {
  for (const int nodes : {150, 256}) {
    expect_agreement(GetParam(), blob_body(nodes, 2), lasting(core::water_scene(), 200));
    expect_agreement(GetParam(), blob_body(nodes, 2), lasting(core::land_scene(), 100));
  }
}

TEST_P(LargeAgreement, OfAnEnsembleAtTheEndOfALongRun) {
  // NUMERICS section 8, test 25, at T = 400. Float64 stays at its rounding.
  const double share = GetParam().round_off / round_off_32;
  for (const core::Scene& scene : {core::water_scene(), core::land_scene()}) {
    std::vector<double> difference, expected_distance, actual_distance;
    for (std::uint64_t seed = 1; seed <= 24; ++seed) {
      const core::Body body = blob_body(26 + 2 * static_cast<int>(seed), seed);
      const core::Scene run = lasting(scene, 400);
      const core::Outcome expected = core::simulate_reference(body, run);
      const core::Outcome actual = GetParam().run(body, run, 100000, [](const core::Frame&) {});
      EXPECT_EQ(expected.status, actual.status);
      difference.push_back(std::fabs(expected.distance - actual.distance));
      expected_distance.push_back(expected.distance);
      actual_distance.push_back(actual.distance);
    }
    // tau > 0.999: none of 276 pairs may be swapped.
    EXPECT_EQ(swapped_pairs(expected_distance, actual_distance), 0) << scene.name;
    std::sort(difference.begin(), difference.end());
    EXPECT_TRUE(within(difference[12], (scene.ground ? 2e-4 : 1e-4) * share)) << scene.name;
    EXPECT_TRUE(within(difference.back(), (scene.ground ? 1e-2 : 1e-4) * share)) << scene.name;
  }
}

}  // namespace
}  // namespace metamorph::tests
