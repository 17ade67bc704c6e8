#pragma once

// What a picture is asked of: a genome and the rules it is shown by.

#include <filesystem>
#include <string>
#include <vector>

#include "evolve/app/rules_options.h"
#include "evolve/experiment/experiment.h"
#include "evolve/run/run_reader.h"
#include "metamorph/outcome.h"

namespace metamorph::evolve {

struct Subject {
  Experiment experiment;
  Genome genome;
  std::string heading;
  int generation = 0;  ///< whose starts the outcomes shown are of
};

enum class SourceKind { run, genome, body };

/// By what lies there and its name; throws InputError for a JSON file of another kind.
SourceKind kind_of(const std::filesystem::path& source);

/// Throws InputError for options that say nothing about such a source, a line for each.
/// `generation` is the name of the one that was given, or empty.
void check_options(SourceKind kind, const RulesOptions& rules, const std::string& generation);

/// The best of a generation, or with -1 of all. Throws InputError if there is none.
Subject subject_of_run(const RunReader& run, int generation);
Subject subject_of_genome(const std::filesystem::path& file, const RulesOptions& rules);

/// What became of it in the trials of its experiment.
std::vector<core::Outcome> outcomes_of(const Subject& subject);

/// The name of a file as a heading.
std::string stem_of(const std::filesystem::path& file);

}  // namespace metamorph::evolve
