#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "metamorph/body.h"
#include "metamorph/development.h"
#include "metamorph/status.h"

namespace metamorph::evolve {

/// How a genome becomes a body.
struct BodyChoice {
  core::DevelopmentRules rules;
  std::vector<int> switches = {};  ///< steps at which the next stage of life begins, ascending
  int stage = 1200;                ///< development step at which the body is taken, <= rules.steps
  int min_cells = 8;               ///< fewer are no body
};

/// Something that can be put into a scene.
struct Animat {
  std::string name;                        ///< the file it came from, printable
  core::Status status = core::Status::ok;  ///< another one: development gave no body
  core::Body body;
};

/// The tag of a JSON file: body_format, genome_format, ...; "" if it has none. Throws InputError if
/// the file cannot be read or is no JSON object.
std::string format_of(const std::filesystem::path& file);

/// What files became, and which files of directories could not be used.
struct AnimatFiles {
  std::vector<Animat> animats;
  int refused = 0;                  ///< files of directories
  std::vector<std::string> faults;  ///< the lines on them
};

/// Reads what `paths` name, in order: body and genome files, and of a directory every such file
/// among its *.json (not below it), ascending by name; embryo files there, which grow writes beside
/// the bodies, are left out. Genomes are grown as one batch. A file of a directory that cannot be
/// used, as one of a genome whose inputs or outputs the rules do not have, does not stop the
/// others. Throws InputError with all faults if a file was named that cannot be used, or a
/// directory without a body or genome, and if nothing is left.
AnimatFiles read_animats(const std::vector<std::filesystem::path>& paths, const BodyChoice& choice,
                         int threads);

}  // namespace metamorph::evolve
