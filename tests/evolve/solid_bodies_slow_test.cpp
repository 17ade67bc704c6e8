#include <gtest/gtest.h>

#include "metamorph/reference.h"
#include "tests/evolve/solid_runs.h"

namespace metamorph::tests {
namespace {

TEST(SolidBodiesOfWholeRuns, NeverCrossThemselvesNorSink) {
  const auto bodies = evolved_bodies();
  for (const core::Precision precision : {core::Precision::float32, core::Precision::float64})
    expect_solid(bodies, 3000, [=](const core::Body& body, const core::Scene& scene, Watch& watch) {
      return run_fast(precision, body, scene, watch);
    });
}

TEST(SolidBodiesOfWholeRuns, NorByTheReference) {
  const auto bodies = evolved_bodies();
  expect_solid(bodies, 1200, [](const core::Body& body, const core::Scene& scene, Watch& watch) {
    core::ReferenceOptions options;
    options.observe_every = 5;
    options.observe = [&](const core::Frame& frame) { watch(frame); };
    return core::simulate_reference(body, scene, options);
  });
}

}  // namespace
}  // namespace metamorph::tests
