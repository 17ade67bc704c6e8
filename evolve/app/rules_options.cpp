#include "evolve/app/rules_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "evolve/experiment/experiment_file.h"
#include "evolve/experiment/keys.h"
#include "evolve/files/input_error.h"

namespace metamorph::evolve {
namespace {

bool is_base(std::string_view name) {
  return std::find(std::begin(scene_bases), std::end(scene_bases), name) != std::end(scene_bases);
}

/// "water, land or pond"
std::string either(const std::vector<std::string>& names) {
  if (names.size() == 1) return names.front();
  return fmt::format("{} or {}", fmt::join(names.begin(), names.end() - 1, ", "), names.back());
}

InputError unknown_scene(const std::string& name, const Experiment& experiment) {
  std::vector<std::string> names(std::begin(scene_bases), std::end(scene_bases));
  for (const NamedScene& named : experiment.scenes) {
    if (!is_base(named.scene.name)) names.push_back(named.scene.name);
  }
  return InputError(fmt::format("--scene: {}: expected {}", name, either(names)));
}

Experiment default_experiment(const std::string& adult_scene,
                              const std::vector<Override>& overrides) {
  const std::string text =
      "name = \"default\"\n"
      "[[trials]]\nname = \"larva\"\nstage = 1\nscene = \"water\"\n"
      "[[trials]]\nname = \"adult\"\nstage = 1\nscene = \"" +
      adult_scene + "\"\n";
  Experiment experiment = parse_experiment(text, "the default experiment", overrides);
  // Stages follow the length of development, unless they were set themselves.
  const int steps = experiment.development.steps;
  const int stages[] = {std::max(1, steps / 2), steps};
  for (std::size_t t = 0; t < experiment.trials.size(); ++t) {
    const bool is_set =
        std::any_of(overrides.begin(), overrides.end(), [&](const Override& change) {
          return change.key == "trials.*.stage" ||
                 change.key == (t == 0 ? "trials.larva.stage" : "trials.adult.stage");
        });
    if (!is_set) experiment.trials[t].stage = stages[t];
  }
  return experiment;
}

}  // namespace

void add_rules_options(CLI::App& command, RulesOptions& options) {
  command
      .add_option("--experiment", options.experiment,
                  "The experiment that says how a genome develops and a body moves")
      ->option_text("FILE.toml [larva at half of development in water, adult at its end on land]");
  command
      .add_option("--set", options.set,
                  "Replaces any key of the experiment (may be repeated), as in "
                  "development.steps=600, body.min_cells=4, locomotion.precision=float64; "
                  "metamorph evolve --keys lists them")
      ->allow_extra_args(false)
      ->option_text("KEY=VALUE");
}

void add_trial_options(CLI::App& command, RulesOptions& options) {
  command
      .add_option("--trial", options.trial,
                  "The trial of the experiment that gives stage and scene (larva, adult, ...)")
      ->option_text("NAME [the first of an experiment that is given]");
  command
      .add_option("--scene", options.scene,
                  "Another scene than the trial's: one of the experiment, or water, land, "
                  "land-right, slope")
      ->option_text("NAME [the trial's, or water]");
}

Experiment experiment_of(const RulesOptions& options) {
  std::vector<Override> overrides;
  for (const std::string& text : options.set) overrides.push_back(parse_override(text));
  if (!options.experiment.empty()) return read_experiment(options.experiment, overrides);
  if (!options.scene.empty() && !is_base(options.scene)) throw unknown_scene(options.scene, {});
  return default_experiment(options.scene.empty() ? "land" : options.scene, overrides);
}

const Trial* trial_of(const Experiment& experiment, const RulesOptions& options) {
  if (options.trial.empty()) {
    return options.experiment.empty() ? nullptr : &experiment.trials.front();
  }
  std::vector<std::string> names;
  for (const Trial& trial : experiment.trials) {
    if (trial.name == options.trial) return &trial;
    names.push_back(trial.name);
  }
  throw InputError(fmt::format("--trial: {}: expected {}", options.trial, either(names)));
}

core::Scene scene_of(const Experiment& experiment, const RulesOptions& options) {
  std::string name = options.scene;
  if (name.empty()) {
    const Trial* trial = trial_of(experiment, options);
    name = trial == nullptr ? "water" : trial->scene;
  }
  for (const NamedScene& named : experiment.scenes) {
    if (named.scene.name == name) return named.scene;
  }
  if (!is_base(name)) throw unknown_scene(name, experiment);
  return base_scene(name);
}

core::LocomotionOptions locomotion_of(const Experiment& experiment, int threads) {
  core::LocomotionOptions options;
  options.precision = experiment.locomotion.precision;
  options.method = experiment.locomotion.method;
  options.threads = threads;
  return options;
}

int larva_steps_of(const Experiment& experiment) {
  const std::vector<int> stages = experiment.stages();
  return stages.size() > 1 ? stages.front() : experiment.development.steps + 1;
}

std::vector<int> steps_at(const Experiment& experiment, std::vector<int> steps) {
  std::sort(steps.begin(), steps.end());
  steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
  const int end = experiment.development.steps;
  if (steps.front() < 0 || steps.back() > end) {
    throw InputError(fmt::format("--at: {}: expected steps from 0 to {}, the end of development",
                                 steps.front() < 0 ? steps.front() : steps.back(), end));
  }
  return steps;
}

}  // namespace metamorph::evolve
