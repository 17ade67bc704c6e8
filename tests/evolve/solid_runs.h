#pragma once

// Runs of evolved bodies, of which every frame is looked at.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/body/outline_crossing.h"
#include "evolve/files/genome_file.h"
#include "evolve/genetics/genome.h"
#include "metamorph/development.h"
#include "metamorph/extraction.h"
#include "metamorph/locomotion.h"
#include "metamorph/scene.h"
#include "metamorph/status.h"
#include "tests/tolerance.h"

namespace metamorph::tests {

/// Larvae and adults of the evolved genomes that come with the benchmarks.
inline std::vector<core::Body> evolved_bodies() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(METAMORPH_BENCH_GENOMES))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<core::Network> networks;
  for (const auto& file : files) networks.push_back(evolve::compile(evolve::read_genome(file)));
  const core::DevelopmentRules rules;
  const int stages[] = {rules.steps / 2, rules.steps};
  std::vector<core::Body> bodies;
  for (const auto& embryos : core::develop(networks, rules, stages, 0))
    for (const core::Embryo& embryo : embryos) {
      core::Extraction extraction = core::extract_body(embryo);
      if (extraction.status == core::Status::ok) bodies.push_back(std::move(extraction.body));
    }
  return bodies;
}

/// Watches frames of a body; every frame it is shown must be sound.
class Watch {
 public:
  explicit Watch(const core::Body& body, bool ground)
      : outline_(core::outline_of(body.triangles)), ground_(ground) {}

  void operator()(const core::Frame& frame) {
    ++frames;
    crossed += core::first_crossing(frame.x, frame.y, outline_).has_value();
    if (!ground_) return;
    deepest = std::min(deepest, *std::min_element(frame.y.begin(), frame.y.end()));
  }

  int frames = 0, crossed = 0;
  double deepest = 0;

 private:
  std::vector<std::array<core::Index, 2>> outline_;
  bool ground_;
};

/// `simulate` of a body in a scene by what calls the watch.
template <class Simulate>
void expect_solid(std::span<const core::Body> bodies, int run_steps, Simulate&& simulate) {
  ASSERT_GE(bodies.size(), 9u);
  for (core::Scene scene : {core::water_scene(), core::land_scene(), core::slope_scene()}) {
    scene.run_steps = std::min(scene.run_steps, run_steps);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      SCOPED_TRACE(scene.name + ", body " + std::to_string(i));
      Watch watch(bodies[i], scene.ground);
      const core::Outcome outcome = simulate(bodies[i], scene, watch);
      // None was bred for the slope: some roll down until they are too fast for a body, or are
      // squeezed where they hit the ground.
      EXPECT_TRUE(!core::is_failure(outcome.status) ||
                  (scene.slope_degrees > 0 && outcome.status != core::Status::crossed))
          << core::name(outcome.status) << " at step " << outcome.failed_step;
      EXPECT_GT(watch.frames, 1);
      EXPECT_EQ(watch.crossed, 0) << "of " << watch.frames;
      // Where the drift ends at the ground: rounding, in float, of heights and speeds.
      EXPECT_TRUE(within(watch.deepest, 16 * round_off_32));
    }
  }
}

inline core::Outcome run_fast(core::Precision precision, const core::Body& body,
                              const core::Scene& scene, Watch& watch) {
  core::LocomotionOptions options;
  options.precision = precision;
  options.threads = 1;
  return core::simulate_observed({&body, &scene}, options, 5,
                                 [&](const core::Frame& frame) { watch(frame); });
}

}  // namespace metamorph::tests
