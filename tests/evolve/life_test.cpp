#include "evolve/life/life.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "evolve/run/run_reader.h"
#include "metamorph/locomotion.h"
#include "tests/bodies.h"
#include "tests/evolve/files.h"
#include "tests/evolve/runs.h"

namespace metamorph::evolve {
namespace {

using tests::run_whole;
using tests::TemporaryDirectory;
using tests::tiny_experiment;

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// By the scene's rule, from the first to the last frame.
double distance_of(const Motion& motion) {
  const Track& track = motion.track;
  return core::travelled(motion.scene.distance, mean(track.x.back()) - mean(track.x.front()),
                         mean(track.y.back()) - mean(track.y.front()));
}

/// An experiment whose adults have three starts, other ones in every generation.
Experiment with_renewed_starts() {
  Experiment experiment = tiny_experiment("simple", 3);
  experiment.trials[1].starts = 3;
  experiment.trials[1].starts_combine = StartsCombine::median;
  experiment.trials[1].starts_renew = true;
  return experiment;
}

TEST(Life, OfAChampionMovesAsItsRecordSays) {
  const TemporaryDirectory place;
  run_whole(place.path() / "run", with_renewed_starts());
  const RunReader run(place.path() / "run");
  const Champion champion = run.best();
  const Experiment experiment = run.experiment();
  const Life life = life_of(experiment, champion.genome, champion.generation, {});
  ASSERT_EQ(life.motions.size(), experiment.trials.size());
  int moved = 0;
  for (std::size_t t = 0; t < life.motions.size(); ++t) {
    const Motion& motion = life.motions[t];
    EXPECT_EQ(motion.name, experiment.trials[t].name);
    if (motion.status != core::Status::ok) continue;
    ++moved;
    EXPECT_EQ(motion.outcome.distance, champion.distances[t]) << motion.name;
    EXPECT_EQ(core::name(motion.outcome.status), champion.statuses[t]);
    EXPECT_EQ(motion.born.size(), motion.body.x.size());
  }
  EXPECT_GT(moved, 0);
}

TEST(Life, ShowsEveryStepOfDevelopmentUpToTheLastStage) {
  const Experiment experiment = tiny_experiment("simple", 1);
  const TemporaryDirectory place;
  run_whole(place.path() / "run", experiment);
  const Genome genome = RunReader(place.path() / "run").best().genome;
  const Life life = life_of(experiment, genome, 0, {});
  EXPECT_EQ(life.end, experiment.stages().back());
  ASSERT_EQ(static_cast<int>(life.embryos.size()), life.end + 1);
  const std::vector<int> some = {0, life.end / 2, life.end};
  const std::vector<core::Embryo> alone = embryos_of(experiment, genome, some);
  for (std::size_t k = 0; k < some.size(); ++k) {
    const core::Embryo& embryo = life.embryos[static_cast<std::size_t>(some[k])];
    EXPECT_EQ(embryo.step, some[k]);
    EXPECT_EQ(embryo.id, alone[k].id);
    EXPECT_EQ(embryo.x, alone[k].x);
  }
}

TEST(Life, FramesOfABodyAreEvenlySpreadFromTheStartToTheEnd) {
  core::Scene scene = core::water_scene();
  scene.run_steps = 300;
  LifeOptions options;
  options.interval = 1;
  const Life life = life_of(tests::strip_body(8), scene, {}, options);
  ASSERT_EQ(life.motions.size(), 1U);
  EXPECT_TRUE(life.embryos.empty());
  const Motion& motion = life.motions.front();
  EXPECT_EQ(motion.track.interval, 5 * motion.scene.step);
  EXPECT_EQ(motion.track.frame_count(), 61);
  EXPECT_EQ(motion.outcome.status, core::Status::ok);
  // Means of floats in another order of summation.
  EXPECT_NEAR(distance_of(motion), motion.outcome.distance, 1e-5);
}

TEST(Life, CopiesAndReferenceAreFramedAlikeAndStayNear) {
  core::Scene scene = core::water_scene();
  scene.run_steps = 300;
  LifeOptions options;
  options.interval = 1;
  options.copies = 2;
  options.reference = true;
  const Motion motion = life_of(tests::strip_body(8), scene, {}, options).motions.front();
  ASSERT_EQ(motion.copies.size(), 2U);
  ASSERT_TRUE(motion.reference.has_value());
  std::vector<Track> tracks = motion.copies;
  tracks.push_back(*motion.reference);
  for (const Track& track : tracks) {
    EXPECT_EQ(track.interval, motion.track.interval);
    ASSERT_EQ(track.frame_count(), motion.track.frame_count());
    double largest = 0;
    for (std::size_t f = 0; f < track.x.size(); ++f) {
      for (std::size_t i = 0; i < track.x[f].size(); ++i) {
        largest = std::max(largest, std::hypot(track.x[f][i] - motion.track.x[f][i],
                                               track.y[f][i] - motion.track.y[f][i]));
      }
    }
    // Displaced by 1e-3 d, or an error of the step: neither nothing nor a part of a body.
    EXPECT_GT(largest, 0);
    EXPECT_LT(largest, 0.05);
  }
}

}  // namespace
}  // namespace metamorph::evolve
