#include "metamorph/locomotion.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "core/body/parallel_for.h"
#include "core/locomotion/body_batch.h"
#include "core/locomotion/runner.h"
#include "metamorph/automatic_step.h"
#include "metamorph/stability.h"
#include "metamorph/step_refusal.h"
#include "metamorph/threads.h"

namespace metamorph::core {
namespace {

/// What is known of a task before anything moves; a status other than ok keeps it from running.
/// Where the scene leaves its steps to the program, the task is given `own`, with steps chosen.
Outcome before_running(LocomotionTask& task, Method method, Scene& own) {
  const Body& body = *task.body;
  Outcome outcome = describe(body);
  if (body.node_count() == 0) {
    outcome.status = Status::empty;
    return outcome;
  }
  if (const auto faults = check(body); !faults.empty()) {
    outcome.status = status_of(faults);
    return outcome;
  }
  if (chooses_steps(*task.scene)) {
    own = with_chosen_steps(body, *task.scene, method);
    task.scene = &own;
  }
  const Scene& scene = *task.scene;
  outcome.step = scene.step;
  if (settles(scene)) outcome.settle_step = scene.settle_step;
  if (const auto refusal = refused_step(body, scene)) {
    outcome.status = refusal->status;
    outcome.failed_value = refusal->largest;
    outcome.failed_index = refusal->node;
    outcome.failed_step = 0;
    return outcome;
  }
  const StepFinding found = assess_steps(body, scene, method);
  outcome.near_step_limit = found.use == StepUse::close;
  if (found.use == StepUse::too_large) {
    const StepPhase phase = step_phase(scene, method, found.settling);
    outcome.status = Status::step_too_large;
    outcome.failed_value = step_limit(body, scene, phase.damping, phase.method).sharp;
    outcome.failed_step = 0;
  }
  return outcome;
}

/// Work to expect of a task, in any unit: longest first keeps the threads busy to the end.
double expected_work(const LocomotionTask& task) {
  const double steps =
      (task.scene->run_steps + (settles(*task.scene) ? 2000 : 0)) * paper_step / task.scene->step;
  return steps * static_cast<double>(task.body->springs.size());
}

template <class T>
std::vector<Outcome> run_all(std::span<const LocomotionTask> given,
                             const LocomotionOptions& options, int every,
                             const std::function<void(const Frame&)>& observe) {
  const int threads = thread_count(options.threads);
  std::vector<LocomotionTask> tasks(given.begin(), given.end());
  std::vector<Scene> own_scenes(tasks.size());
  std::vector<Outcome> outcomes(tasks.size());
  parallel_for<Schedule::dynamic>(tasks.size(), threads, [&](std::size_t index) {
    outcomes[index] = before_running(tasks[index], options.method, own_scenes[index]);
  });

  std::vector<std::size_t> sound;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    if (outcomes[i].status == Status::ok) sound.push_back(i);
  }
  std::sort(sound.begin(), sound.end(), [&](std::size_t a, std::size_t b) {
    const double work_a = expected_work(tasks[a]), work_b = expected_work(tasks[b]);
    return work_a != work_b ? work_a > work_b : a < b;
  });
  std::vector<LocomotionTask> packed;
  for (std::size_t i : sound) packed.push_back(tasks[i]);

  BodyBatch<T> batch(packed, options.method == Method::drift_kick_drift, threads);
  parallel_for<Schedule::dynamic>(
      packed.size(), threads, [&] { return Runner<T>(batch, options.method); },
      [&](Runner<T>& runner, std::size_t index) {
        // A copy, for it is written in every step: its neighbours are other threads'.
        Outcome outcome = outcomes[sound[index]];
        runner.run(index, packed[index], outcome, every, observe);
        outcomes[sound[index]] = outcome;
      });
  return outcomes;
}

}  // namespace

std::vector<Outcome> simulate(std::span<const LocomotionTask> tasks,
                              const LocomotionOptions& options) {
  return options.precision == Precision::float32 ? run_all<float>(tasks, options, 0, {})
                                                 : run_all<double>(tasks, options, 0, {});
}

Outcome simulate_observed(const LocomotionTask& task, const LocomotionOptions& options, int every,
                          const std::function<void(const Frame&)>& observe) {
  const std::span<const LocomotionTask> tasks(&task, 1);
  return options.precision == Precision::float32
             ? run_all<float>(tasks, options, every, observe).front()
             : run_all<double>(tasks, options, every, observe).front();
}

}  // namespace metamorph::core
