#pragma once

#include <string>
#include <vector>

#include "evolve/experiment/experiment_file.h"
#include "evolve/files/input_error.h"

namespace metamorph::tests {

/// The lines that a text costs; none: it is an experiment.
inline std::vector<std::string> faults_of(const std::string& text,
                                          const std::vector<evolve::Override>& overrides = {}) {
  try {
    evolve::parse_experiment(text, "x.toml", overrides);
  } catch (const evolve::InputError& error) {
    return error.lines();
  }
  return {};
}

/// An experiment in nine lines.
inline constexpr const char* good =
    "name = \"x\"\n"
    "[[trials]]\nname = \"larva\"\nstage = 600\nscene = \"water\"\n"
    "[[trials]]\nname = \"adult\"\nstage = 1200\nscene = \"land\"\n";

}  // namespace metamorph::tests
