#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "evolve/experiment/experiment.h"

namespace metamorph::evolve {

/// A value that replaces the file's: key is a full path such as "generations", "neat.population",
/// "trials.larva.stage" or "scenes.water.gravity"; "scenes.*.run_steps" means all scenes. A value
/// that is no TOML is taken as a string. `origin` is how the person gave it ("--set", "--seed").
struct Override {
  std::string origin;
  std::string key;
  std::string value;
};

/// Splits "key=value" as given to --set. Throws InputError.
Override parse_override(std::string_view text);

/// Reads an experiment (TOML). Keys that are not given keep the defaults of the model; unknown
/// keys, wrong types, values out of range and contradictions throw one InputError with all faults,
/// one line each. `source` is the name of the file in those lines.
Experiment parse_experiment(std::string_view text, const std::string& source,
                            const std::vector<Override>& overrides = {});
Experiment read_experiment(const std::filesystem::path& file,
                           const std::vector<Override>& overrides = {});

/// The complete experiment, every default written out: TOML text that parses to the same
/// experiment, all numbers to the same bits.
std::string to_toml(const Experiment& experiment);

/// All keys with default, range and meaning, for a terminal.
std::string describe_keys();

}  // namespace metamorph::evolve
