#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "evolve/app/commands.h"
#include "evolve/app/options.h"
#include "evolve/app/rules_options.h"
#include "evolve/app/streams.h"
#include "evolve/app/text.h"
#include "evolve/files/animat_file.h"
#include "evolve/files/input_error.h"
#include "evolve/files/outcome_json.h"
#include "evolve/files/output_file.h"
#include "evolve/files/trajectory_file.h"
#include "metamorph/automatic_step.h"
#include "metamorph/locomotion.h"
#include "metamorph/stability.h"
#include "metamorph/step_refusal.h"
#include "metamorph/threads.h"

namespace metamorph::evolve {
namespace {

struct SimulateOptions {
  std::vector<std::string> inputs;
  RulesOptions rules;
  std::string step;   ///< "": the scene's own; a number or "auto"
  int run_steps = 0;  ///< 0: the scene's own
  int stage = 0;      ///< 0: the trial's, or the end of development
  int threads = 0;
  std::string trajectory;
  int every = 0;  ///< 0: one paper step
  bool overwrite = false;
  bool json = false;
};

core::Scene scene_to_run(const Experiment& experiment, const SimulateOptions& options) {
  core::Scene scene = scene_of(experiment, options.rules);
  if (options.step == "auto") {
    scene.step = scene.settle_step = core::automatic_step;
  } else if (!options.step.empty()) {
    scene.step = std::stod(options.step);
  }
  if (options.run_steps > 0) scene.run_steps = options.run_steps;
  return scene;
}

AnimatFiles animats_of(const Experiment& experiment, const SimulateOptions& options) {
  BodyChoice choice;
  choice.rules = experiment.development;
  choice.switches = experiment.metamorphoses();
  choice.min_cells = experiment.min_cells;
  const Trial* trial = trial_of(experiment, options.rules);
  choice.stage = trial == nullptr ? choice.rules.steps : trial->stage;
  if (options.stage > 0) choice.stage = options.stage;
  if (choice.stage > choice.rules.steps) {
    throw InputError(fmt::format("--stage: {}: expected at most {}, the end of development",
                                 choice.stage, choice.rules.steps));
  }
  const std::vector<std::filesystem::path> paths(options.inputs.begin(), options.inputs.end());
  return read_animats(paths, choice, options.threads);
}

core::Outcome without_body(core::Status status) {
  core::Outcome outcome;
  outcome.status = status;
  return outcome;
}

/// All animats as one batch; those without a body keep their status.
std::vector<core::Outcome> simulate_all(const std::vector<Animat>& animats,
                                        const core::Scene& scene,
                                        const core::LocomotionOptions& options) {
  std::vector<core::LocomotionTask> tasks;
  for (const Animat& animat : animats) {
    if (animat.status == core::Status::ok) tasks.push_back({&animat.body, &scene});
  }
  const std::vector<core::Outcome> moved = core::simulate(tasks, options);
  std::vector<core::Outcome> outcomes;
  auto next = moved.begin();
  for (const Animat& animat : animats) {
    outcomes.push_back(animat.status == core::Status::ok ? *next++ : without_body(animat.status));
  }
  return outcomes;
}

/// Before the first step: which fixed steps come close to their limit. One line for all bodies.
void warn_of_steps(const std::vector<Animat>& animats, const core::Scene& scene,
                   core::Method method) {
  std::size_t bodies = 0, close = 0;
  std::string first;
  for (const Animat& animat : animats) {
    if (animat.status != core::Status::ok || !core::check(animat.body).empty()) continue;
    ++bodies;
    const core::Scene own = core::with_chosen_steps(animat.body, scene, method);
    const core::StepFinding found = core::assess_steps(animat.body, own, method);
    if (found.use != core::StepUse::close || ++close > 1) continue;
    const core::StepPhase phase = core::step_phase(own, method, found.settling);
    const double limit = core::step_limit(animat.body, own, phase.damping, phase.method).sharp;
    first = fmt::format(
        "{}: {}step {} is {:.0f} % of the largest stable one, {:.3g}: expected at most {:.0f} %",
        animat.name, found.settling ? "settling " : "", phase.step, 100 * phase.step / limit, limit,
        100 * phase.margin);
  }
  if (close == 0) return;
  tell("warning: {}{}; --dt auto chooses one\n", first,
       close == 1 ? "" : fmt::format(", and so for {} of {} bodies", close, bodies));
}

/// Steps that no body of these could be moved with are a mistake of who asks, like a fault in a
/// file: all of them are told, and nothing is moved.
void check_steps(const std::vector<Animat>& animats, const core::Scene& scene) {
  std::vector<std::string> faults;
  for (const Animat& animat : animats) {
    if (animat.status != core::Status::ok || !core::check(animat.body).empty()) continue;
    const auto refusal = core::refused_step(animat.body, scene);
    if (!refusal) continue;
    faults.push_back(fmt::format(
        "{}: step {}: expected at most {:.6g}, {}", animat.name, scene.step, refusal->largest,
        refusal->node < 0 ? "the length of the run"
                          : fmt::format("a quarter of the period of node {}", refusal->node)));
  }
  if (!faults.empty()) throw InputError(faults);
}

/// Before the first step of work that takes long: how much it is.
void tell_work(const std::vector<Animat>& animats, const core::Scene& scene,
               const core::LocomotionOptions& options) {
  double most_steps = 0, spring_steps = 0;
  int bodies = 0;
  for (const Animat& animat : animats) {
    if (animat.status != core::Status::ok || !core::check(animat.body).empty()) continue;
    const core::Scene own = core::with_chosen_steps(animat.body, scene, options.method);
    double steps = own.run_steps * core::paper_step / own.step;
    if (core::settles(own)) steps += own.settle_quiet_steps * core::paper_step / own.settle_step;
    most_steps = std::max(most_steps, steps);
    spring_steps += steps * static_cast<double>(animat.body.springs.size());
    ++bodies;
  }
  const int threads = core::thread_count(options.threads);
  const std::string work =
      work_text(most_steps, spring_steps, std::clamp(threads, 1, std::max(bodies, 1)));
  if (!work.empty()) tell("long work: {}\n", work);
}

core::Outcome simulate_with_trajectory(const Animat& animat, const core::Scene& given,
                                       const core::LocomotionOptions& locomotion,
                                       const SimulateOptions& options) {
  if (animat.status != core::Status::ok) return without_body(animat.status);
  const core::Scene scene = core::with_chosen_steps(animat.body, given, locomotion.method);
  TrajectoryWriter writer(options.trajectory, options.overwrite ? Overwrite::yes : Overwrite::no);
  const int paper_step = std::max(1, static_cast<int>(std::lround(core::paper_step / scene.step)));
  const core::Outcome outcome = core::simulate_observed(
      {&animat.body, &scene}, locomotion, options.every > 0 ? options.every : paper_step,
      [&](const core::Frame& frame) { writer.write(frame); });
  writer.finish();
  return outcome;
}

void print_table(const std::vector<Animat>& animats, const std::vector<core::Outcome>& outcomes) {
  std::size_t width = 4;
  for (const Animat& animat : animats) width = std::max(width, animat.name.size());
  fmt::print("{:<{}}  {:<14} {:>10} {:>9} {:>9} {:>5} {:>7} {:>9} {:>6} {:>8} {:>7} {:>8} {:>9}\n",
             "file", width, "status", "distance/d", "x/d", "y/d", "cells", "springs", "triangles",
             "step", "steps", "settle", "min S/S0", "max speed");
  for (std::size_t i = 0; i < animats.size(); ++i) {
    const core::Outcome& o = outcomes[i];
    fmt::print(
        "{:<{}}  {:<14} {:>10.4f} {:>9.4f} {:>9.4f} {:>5} {:>7} {:>9} {:>6.4g} {:>8} {:>7.1f} "
        "{:>8.4f} "
        "{:>9.4f}\n",
        animats[i].name, width, core::name(o.status), o.distance, o.mean_position[0],
        o.mean_position[1], o.cells, o.springs, o.triangles, o.step, o.steps, o.settle_time,
        o.min_area_ratio, o.max_speed);
    const std::string failure = failure_text(o, animats[i].body);
    if (!failure.empty()) fmt::print("{:<{}}  {}\n", "", width, failure);
  }
}

void simulate_command(const SimulateOptions& options) {
  if (!options.trajectory.empty()) {
    check_writable(options.trajectory, options.overwrite ? Overwrite::yes : Overwrite::no);
  }
  const Experiment experiment = experiment_of(options.rules);
  const core::Scene scene = scene_to_run(experiment, options);
  const core::LocomotionOptions locomotion = locomotion_of(experiment, options.threads);
  const AnimatFiles files = animats_of(experiment, options);
  const std::vector<Animat>& animats = files.animats;
  for (const std::string& line : files.faults) tell("{}\n", line);
  check_steps(animats, scene);
  tell_work(animats, scene, locomotion);
  warn_of_steps(animats, scene, locomotion.method);
  std::vector<core::Outcome> outcomes;
  if (options.trajectory.empty()) {
    outcomes = simulate_all(animats, scene, locomotion);
  } else if (animats.size() == 1) {
    outcomes = {simulate_with_trajectory(animats.front(), scene, locomotion, options)};
  } else {
    throw InputError(fmt::format("--trajectory: {} bodies: expected one", animats.size()));
  }
  if (!options.json) print_table(animats, outcomes);
  for (std::size_t i = 0; options.json && i < animats.size(); ++i) {
    fmt::print("{}\n",
               outcome_json({{"file", animats[i].name}, {"scene", scene.name}}, outcomes[i]));
  }
  if (files.refused > 0) {
    throw InputError(fmt::format("simulate: {} of {} files refused, the others were simulated",
                                 files.refused,
                                 animats.size() + static_cast<std::size_t>(files.refused)));
  }
}

}  // namespace

void add_simulate_command(CLI::App& app) {
  const auto options = std::make_shared<SimulateOptions>();
  CLI::App* command = app.add_subcommand("simulate",
                                         "Moves bodies in a scene and prints how far they got. "
                                         "Several files, or those of a directory, "
                                         "run as one batch; a genome is developed first. "
                                         "Files of a directory that cannot be used are named "
                                         "and left out. "
                                         "Every body moves once, from where it is, also where "
                                         "a trial has several starts.");
  command
      ->add_option("INPUT", options->inputs,
                   "Body or genome files, or directories of them; genomes are developed first")
      ->required()
      ->option_text("FILE|DIRECTORY...");
  add_rules_options(*command, options->rules);
  add_trial_options(*command, options->rules);
  command->add_option("--steps", options->run_steps, "Length of the run, in paper steps of 0.2")
      ->check(integer_from(1, 100000000))
      ->option_text("STEPS [the scene's, 3000]");
  command
      ->add_option(
          "--dt", options->step,
          "Step of the integrator, in time units; auto: chosen for each body from its stiffness, "
          "also while it settles")
      ->check(number_from(1e-6, 10, "auto"))
      ->option_text("TIME|auto [the scene's, 0.2 in water, 0.15 on land]");
  command->add_option("--threads", options->threads, "Threads; 0 for all there are")
      ->check(integer_from(0, 4096))
      ->option_text("N [0]");
  command
      ->add_option("--stage", options->stage, "Development step at which a genome's body is taken")
      ->check(integer_from(1, 1000000))
      ->option_text("STEP [the trial's, or the end of development]");
  command
      ->add_option("--trajectory", options->trajectory,
                   "Write the motion of a single body as CSV: step, time, node, x, y, vx, vy")
      ->option_text("FILE.csv");
  command->add_option("--every", options->every, "Integrator steps between two frames written")
      ->check(integer_from(1, 100000000))
      ->option_text("N [one paper step]");
  command->add_flag("--overwrite", options->overwrite, "Replace a file that exists");
  command->add_flag("--json", options->json, "Print one JSON object per body instead of a table");
  command->callback([options] { simulate_command(*options); });
}

}  // namespace metamorph::evolve
