#pragma once

// The rules by which a command develops and moves what it is given: those of an experiment.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "evolve/experiment/experiment.h"
#include "metamorph/locomotion.h"
#include "metamorph/scene.h"

namespace metamorph::evolve {

struct RulesOptions {
  std::string experiment;        ///< file; empty: the default experiment
  std::vector<std::string> set;  ///< key=value
  std::string trial;             ///< empty: none was named
  std::string scene;             ///< empty: none was named
};

/// --experiment and --set.
void add_rules_options(CLI::App& command, RulesOptions& options);

/// --trial and --scene, for a command that moves what has no scene of its own.
void add_trial_options(CLI::App& command, RulesOptions& options);

/// The experiment of the file with what --set changes. Without a file: a larva at half of
/// development in water, an adult at its end on land, or in the scene named. Throws InputError.
Experiment experiment_of(const RulesOptions& options);

/// The trial named, or the first one of an experiment that was given; else nullptr. Points into the
/// experiment. Throws InputError if there is none of that name.
const Trial* trial_of(const Experiment& experiment, const RulesOptions& options);

/// The scene named, of the experiment or else of the model; or that of the trial; or water. Throws
/// InputError.
core::Scene scene_of(const Experiment& experiment, const RulesOptions& options);

core::LocomotionOptions locomotion_of(const Experiment& experiment, int threads = 0);

/// From which step on cells count as born in metamorphosis: the first stage; never where there is
/// one alone.
int larva_steps_of(const Experiment& experiment);

/// The steps asked for with --at, ascending, each once. Throws InputError beyond development.
std::vector<int> steps_at(const Experiment& experiment, std::vector<int> steps);

}  // namespace metamorph::evolve
