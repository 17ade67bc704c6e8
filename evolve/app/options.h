#pragma once

// Options that several commands have.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "metamorph/development.h"
#include "metamorph/locomotion.h"
#include "metamorph/scene.h"

namespace metamorph::evolve {

/// Checks of an option's value that say what was expected: "moon: expected water, land or slope".
CLI::Validator one_of(std::vector<std::string> names);
CLI::Validator integer_from(int low, int high);
/// `or_word`, if not empty, is taken as well.
CLI::Validator number_from(double low, double high, std::string or_word = "");

/// The rules by which a genome develops.
void add_development_options(CLI::App& command, core::DevelopmentRules& rules, int& min_cells);

/// How a body moves, whatever the scene.
void add_locomotion_options(CLI::App& command, core::LocomotionOptions& options);

/// --scene; one of the four environments of the model.
void add_scene_option(CLI::App& command, std::string& name);

/// The scene of that name.
core::Scene scene_named(const std::string& name);

}  // namespace metamorph::evolve
