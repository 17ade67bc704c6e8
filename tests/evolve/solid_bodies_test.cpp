// Evolved bodies keep out of themselves and of the ground, whatever they do.

#include <gtest/gtest.h>

#include "tests/evolve/solid_runs.h"

namespace metamorph::tests {
namespace {

TEST(SolidBodies, NoneOfTheEvolvedCrossesItselfOrSinks) {
  // Three cycles at full swing.
  const auto bodies = evolved_bodies();
  expect_solid(bodies, 800, [](const core::Body& body, const core::Scene& scene, Watch& watch) {
    return run_fast(core::Precision::float32, body, scene, watch);
  });
}

}  // namespace
}  // namespace metamorph::tests
