#include "evolve/app/life_sources.h"

#include <string>
#include <vector>

#include "evolve/app/options.h"
#include "evolve/app/subject.h"
#include "evolve/files/body_file.h"
#include "evolve/run/run_reader.h"

namespace metamorph::evolve {
namespace {

Life life_of_subject(const Subject& subject, const LifeOptions& options) {
  Life life = life_of(subject.experiment, subject.genome, subject.generation, options);
  life.heading = subject.heading;
  return life;
}

Life life_of_body(const std::string& file, const RulesOptions& rules, const LifeOptions& options) {
  const Experiment experiment = experiment_of(rules);
  Life life = life_of(read_body(file), scene_of(experiment, rules),
                      locomotion_of(experiment, options.threads), options);
  life.heading = stem_of(file);
  return life;
}

/// Those named, or every n-th and the last one; -1: the best of all.
std::vector<int> generations_of(const RunReader& run, const LifeSources& sources) {
  std::vector<int> generations = sources.generations;
  if (sources.every > 0) {
    const int done = run.generations_done();
    for (int g = 0; g < done - 1; g += sources.every) generations.push_back(g);
    generations.push_back(done - 1);
  }
  if (generations.empty()) generations.push_back(-1);
  return generations;
}

}  // namespace

void add_life_sources(CLI::App& command, LifeSources& sources) {
  command
      .add_option("SOURCE", sources.sources,
                  "Directories of runs or their run.db, genome files, body files")
      ->required()
      ->option_text("RUN|GENOME.json|BODY.json...");
  CLI::Option* generations =
      command
          .add_option("--generations", sources.generations,
                      "Of a run: the best of these generations, separated by commas")
          ->delimiter(',')
          ->check(integer_from(0, 100000000))
          ->option_text("N,... [the best of all]");
  command
      .add_option("--every-generation", sources.every,
                  "Of a run: the best of every N-th generation, and of the last one")
      ->check(integer_from(1, 100000000))
      ->option_text("N")
      ->excludes(generations);
  add_rules_options(command, sources.rules);
  command
      .add_option("--scene", sources.rules.scene,
                  "Of bodies: one of the experiment, or water, land, land-right, slope")
      ->option_text("NAME [water]");
}

void each_life(const LifeSources& sources, const LifeOptions& options,
               const std::function<void(Life)>& receive) {
  const std::string given = !sources.generations.empty() ? "--generations"
                            : sources.every > 0          ? "--every-generation"
                                                         : "";
  for (const std::string& source : sources.sources) {
    const SourceKind kind = kind_of(source);
    check_options(kind, sources.rules, given);
    if (kind == SourceKind::body) {
      receive(life_of_body(source, sources.rules, options));
    } else if (kind == SourceKind::genome) {
      receive(life_of_subject(subject_of_genome(source, sources.rules), options));
    } else {
      const RunReader run(source);
      for (const int generation : generations_of(run, sources)) {
        receive(life_of_subject(subject_of_run(run, generation), options));
      }
    }
  }
}

}  // namespace metamorph::evolve
