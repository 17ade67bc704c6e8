#include "evolve/life/life.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "evolve/evaluation/displaced.h"
#include "evolve/evaluation/starts.h"
#include "metamorph/automatic_step.h"
#include "metamorph/extraction.h"
#include "metamorph/random.h"
#include "metamorph/reference.h"

namespace metamorph::evolve {
namespace {

constexpr int reference_refinement = 4;  // of the step

struct Course {
  core::Outcome outcome;
  Track track;
};

void keep(const core::Frame& frame, Track& track) {
  track.x.emplace_back(frame.x.begin(), frame.x.end());
  track.y.emplace_back(frame.y.begin(), frame.y.end());
}

/// Integrator steps between two frames.
int steps_between(double interval, const core::Scene& scene) {
  return std::max(1, static_cast<int>(std::lround(interval / scene.step)));
}

Course run(const core::Body& body, const core::Scene& scene,
           const core::LocomotionOptions& locomotion, double interval) {
  const int every = steps_between(interval, scene);
  Course course;
  course.track.interval = every * scene.step;
  course.outcome =
      core::simulate_observed({&body, &scene}, locomotion, every,
                              [&](const core::Frame& frame) { keep(frame, course.track); });
  return course;
}

Track run_reference(const core::Body& body, const core::Scene& scene, double interval) {
  const int every = steps_between(interval, scene);
  Track track;
  track.interval = every * scene.step;
  core::ReferenceOptions options;
  options.step = scene.step / reference_refinement;
  options.observe_every = reference_refinement * every;
  options.observe = [&](const core::Frame& frame) { keep(frame, track); };
  core::simulate_reference(body, scene, options);
  return track;
}

core::Body nearby(const core::Body& body, int copy, double displacement) {
  return displaced(body, displacement,
                   RandomStream(Purpose::nearby_start, 1, static_cast<std::uint32_t>(copy), 0));
}

/// The starts of a trial, the one that tells its outcome first.
std::vector<core::Body> starts_of(const core::Body& body, const Trial& trial,
                                  const Experiment& experiment, int generation,
                                  const core::Scene& scene,
                                  const core::LocomotionOptions& locomotion) {
  std::vector<core::Body> starts;
  for (int s = 0; s < trial.starts; ++s) {
    starts.push_back(start_of(body, trial, s, experiment.seed, generation));
  }
  if (starts.size() == 1) return starts;
  std::vector<core::LocomotionTask> tasks;
  for (const core::Body& start : starts) tasks.push_back({&start, &scene});
  const std::vector<core::Outcome> outcomes = core::simulate(tasks, locomotion);
  std::swap(starts.front(), starts[telling_start(outcomes, trial.starts_combine)]);
  return starts;
}

/// Fills in scene, outcome and tracks: starts.front() is the body shown.
void move(std::vector<core::Body> starts, const core::Scene& scene,
          const core::LocomotionOptions& locomotion, const LifeOptions& options, Motion& motion) {
  motion.body = std::move(starts.front());
  motion.scene = core::with_chosen_steps(motion.body, scene, locomotion.method);
  Course course = run(motion.body, motion.scene, locomotion, options.interval);
  motion.outcome = course.outcome;
  motion.track = std::move(course.track);
  for (int c = 0; c < options.copies; ++c) {
    const auto other = static_cast<std::size_t>(c) + 1;
    // All take the same steps, or the difference would be one of steps as well.
    motion.copies.push_back(
        run(other < starts.size() ? starts[other] : nearby(motion.body, c, options.displacement),
            motion.scene, locomotion, options.interval)
            .track);
  }
  if (options.reference) {
    motion.reference = run_reference(motion.body, motion.scene, options.interval);
  }
}

}  // namespace

std::vector<double> speeds_at(const Track& track, int frame) {
  const auto from = static_cast<std::size_t>(std::max(frame - 1, 0));
  const auto to = std::min(from + 1, track.x.size() - 1);
  std::vector<double> speeds(track.x[to].size());
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    speeds[i] = std::hypot(track.x[to][i] - track.x[from][i], track.y[to][i] - track.y[from][i]) /
                track.interval;
  }
  return speeds;
}

Life life_of(const Experiment& experiment, const Genome& genome, int generation,
             const LifeOptions& options) {
  Life life;
  life.genome = genome;
  life.generation = generation;
  life.end = experiment.stages().back();
  life.starts = experiment.metamorphoses();
  std::vector<int> steps(static_cast<std::size_t>(life.end) + 1);
  std::iota(steps.begin(), steps.end(), 0);
  life.embryos = embryos_of(experiment, genome, steps);
  const core::LocomotionOptions locomotion{experiment.locomotion.precision,
                                           experiment.locomotion.method, options.threads};
  for (const Trial& trial : experiment.trials) {
    const core::Embryo& embryo = life.embryos[static_cast<std::size_t>(trial.stage)];
    core::Extraction extraction = core::extract_body(embryo, experiment.min_cells);
    Motion motion;
    motion.name = trial.name;
    motion.stage = trial.stage;
    motion.status = extraction.status;
    motion.scene = experiment.scene_of(trial);
    motion.born = birth_stages(extraction.body, embryo, life.starts);
    if (extraction.status == core::Status::ok) {
      move(starts_of(extraction.body, trial, experiment, generation, motion.scene, locomotion),
           motion.scene, locomotion, options, motion);
    }
    life.motions.push_back(std::move(motion));
  }
  return life;
}

Life life_of(const core::Body& body, const core::Scene& scene,
             const core::LocomotionOptions& locomotion, const LifeOptions& options) {
  Life life;
  Motion motion;
  motion.name = "body";
  core::LocomotionOptions own = locomotion;
  own.threads = options.threads;
  move({body}, scene, own, options, motion);
  life.motions.push_back(std::move(motion));
  return life;
}

}  // namespace metamorph::evolve
