#pragma once

// Options that several commands have.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace metamorph::evolve {

/// Checks of an option's value that say what was expected: "moon: expected water, land or slope".
CLI::Validator one_of(std::vector<std::string> names);
CLI::Validator integer_from(int low, int high);
/// `or_word`, if not empty, is taken as well.
CLI::Validator number_from(double low, double high, std::string or_word = "");

}  // namespace metamorph::evolve
