#include "evolve/app/subject.h"

#include <fmt/format.h>

#include <utility>

#include "evolve/files/animat_file.h"
#include "evolve/files/body_file.h"
#include "evolve/files/genome_file.h"
#include "evolve/files/input_error.h"
#include "evolve/files/printable.h"
#include "evolve/run/pictures.h"

namespace metamorph::evolve {
namespace {

/// Each of the options given gets its line.
void refuse(const std::vector<std::pair<std::string, bool>>& options, const std::string& why) {
  std::vector<std::string> faults;
  for (const auto& [name, is_given] : options) {
    if (is_given) faults.push_back(fmt::format("{}: {}", name, why));
  }
  if (!faults.empty()) throw InputError(faults);
}

}  // namespace

SourceKind kind_of(const std::filesystem::path& source) {
  if (std::filesystem::is_directory(source) || source.extension() == ".db") return SourceKind::run;
  return format_of(source) == body_format ? SourceKind::body : SourceKind::genome;
}

void check_options(SourceKind kind, const RulesOptions& rules, const std::string& generation) {
  if (kind == SourceKind::run) {
    refuse({{"--experiment", !rules.experiment.empty()},
            {"--set", !rules.set.empty()},
            {"--scene", !rules.scene.empty()}},
           "not together with a run, which is shown by its own rules");
    return;
  }
  const bool is_body = kind == SourceKind::body;
  refuse({{generation, !generation.empty()}},
         fmt::format("expected a run, not a {}", is_body ? "body" : "genome"));
  if (is_body) return;
  refuse({{"--scene", !rules.scene.empty()}},
         "expected a body: a genome moves in the scene of its trial (--trial)");
}

Subject subject_of_run(const RunReader& run, int generation) {
  if (run.generations_done() == 0) {
    throw InputError(run.file().string() + ": no generation is done yet");
  }
  Subject subject{run.experiment(), {}, ""};
  const Champion champion = generation >= 0 ? run.champion(generation) : run.best();
  subject.genome = champion.genome;
  subject.generation = champion.generation;
  subject.heading =
      fmt::format("{}, seed {}: best of generation {}, {:.3f} d (eq 6)", subject.experiment.name,
                  subject.experiment.seed, champion.generation, champion.eq6);
  return subject;
}

Subject subject_of_genome(const std::filesystem::path& file, const RulesOptions& rules) {
  Experiment experiment = experiment_of(rules);
  Genome genome = read_genome(file, experiment.development);
  return {std::move(experiment), std::move(genome), stem_of(file)};
}

std::vector<core::Outcome> outcomes_of(const Subject& subject) {
  return outcomes_of(subject.experiment, subject.genome, subject.generation);
}

std::string stem_of(const std::filesystem::path& file) { return printable(file.stem().string()); }

}  // namespace metamorph::evolve
