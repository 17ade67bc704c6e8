#include "evolve/app/life_sources.h"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "evolve/app/options.h"
#include "evolve/files/animat_file.h"
#include "evolve/files/body_file.h"
#include "evolve/files/genome_file.h"
#include "evolve/files/input_error.h"
#include "evolve/files/printable.h"
#include "evolve/run/run_reader.h"

namespace metamorph::evolve {
namespace {

/// An option that says nothing about such a source.
void refuse(bool is_given, const char* option, const std::string& why) {
  if (is_given) throw InputError(fmt::format("{}: {}", option, why));
}

void refuse_generations(const LifeSources& sources, const std::string& what) {
  const std::string why = "expected a run, not a " + what;
  refuse(!sources.generations.empty(), "--generations", why);
  refuse(sources.every > 0, "--every-generation", why);
}

Life life_of_champion(const Experiment& experiment, const Champion& champion,
                      const LifeOptions& options) {
  Life life = life_of(experiment, champion.genome, champion.generation, options);
  life.heading = fmt::format("{}, seed {}: best of generation {}, {:.3f} d (eq 6)", experiment.name,
                             experiment.seed, champion.generation, champion.eq6);
  return life;
}

void each_life_of_run(const std::string& source, const LifeSources& sources,
                      const LifeOptions& options, const std::function<void(Life)>& receive) {
  const std::string why = "not together with a run, which is shown by its own rules";
  refuse(!sources.rules.experiment.empty(), "--experiment", why);
  refuse(!sources.rules.set.empty(), "--set", why);
  refuse(!sources.rules.scene.empty(), "--scene", why);
  const RunReader run(source);
  const int done = run.generations_done();
  if (done == 0) throw InputError(source + ": no generation is done yet");
  const Experiment experiment = run.experiment();
  std::vector<int> generations = sources.generations;
  if (sources.every > 0) {
    for (int g = 0; g < done; g += sources.every) generations.push_back(g);
    if (generations.back() != done - 1) generations.push_back(done - 1);
  }
  if (generations.empty()) receive(life_of_champion(experiment, run.best(), options));
  for (const int generation : generations) {
    receive(life_of_champion(experiment, run.champion(generation), options));
  }
}

Life life_of_file(const std::string& source, const LifeSources& sources,
                  const LifeOptions& options) {
  const Experiment experiment = experiment_of(sources.rules);
  const std::filesystem::path file(source);
  Life life;
  if (format_of(file) == body_format) {
    refuse_generations(sources, "body");
    const core::Scene scene = scene_of(experiment, sources.rules);
    life = life_of(read_body(source), scene, locomotion_of(experiment, options.threads), options);
  } else {
    refuse_generations(sources, "genome");
    refuse(!sources.rules.scene.empty(), "--scene",
           "expected a body: a genome moves in the scenes of its trials");
    life = life_of(experiment, read_genome(source, experiment.development), 0, options);
  }
  life.heading = printable(file.stem().string());
  return life;
}

}  // namespace

bool is_run(const std::string& source) {
  const std::filesystem::path path(source);
  return std::filesystem::is_directory(path) || path.extension() == ".db";
}

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
  for (const std::string& source : sources.sources) {
    if (is_run(source)) {
      each_life_of_run(source, sources, options, receive);
    } else {
      receive(life_of_file(source, sources, options));
    }
  }
}

}  // namespace metamorph::evolve
