#include "evolve/run/pictures.h"

#include <fmt/format.h>

#include <algorithm>

#include "metamorph/extraction.h"

namespace metamorph::evolve {

std::vector<Stage> stages_of(const Experiment& experiment, const Genome& genome,
                             std::span<const core::Outcome> trials) {
  const std::vector<int> steps = experiment.stages();
  const std::vector<core::Embryo> embryos = embryos_of(experiment, genome, steps);
  std::vector<Stage> stages;
  for (std::size_t t = 0; t < experiment.trials.size(); ++t) {
    const Trial& trial = experiment.trials[t];
    const auto step = std::lower_bound(steps.begin(), steps.end(), trial.stage) - steps.begin();
    Stage stage;
    stage.title = trial.name;
    stage.embryo = embryos[static_cast<std::size_t>(step)];
    stage.body = core::extract_body(stage.embryo, experiment.min_cells).body;
    if (t < trials.size()) stage.outcome = trials[t];
    stage.scene = trial.scene;
    stage.ground = core::shows_ground(experiment.scene_of(trial));
    stages.push_back(std::move(stage));
  }
  return stages;
}

std::vector<core::Outcome> outcomes_of(const Experiment& experiment, const Genome& genome,
                                       int generation) {
  return Evaluator(rules_of(experiment), 1)
      .evaluate_fully(networks_of(experiment, genome), generation)
      .trials;
}

Sheet individual_sheet(const Experiment& experiment, const Genome& genome,
                       std::span<const core::Outcome> trials, const std::string& heading) {
  const std::vector<Stage> stages = stages_of(experiment, genome, trials);
  Sheet sheet = champion_sheet(stages, experiment.metamorphoses());
  sheet.heading = heading;
  return sheet;
}

void PictureReporter::started(const RunStart& start) {
  directory_ = start.directory;
  if (start.best.generation < 0) return;
  draw(start.experiment, start.best,
       [&] { return outcomes_of(start.experiment, start.best.genome, start.best.generation); });
}

void PictureReporter::generation_done(const GenerationReport& report) {
  if (!report.improved) return;
  draw(report.experiment, report.best,
       [&] { return report.result.individuals[report.result.champion].trials; });
}

void PictureReporter::draw(const Experiment& experiment, const BestEver& best,
                           const std::function<std::vector<core::Outcome>()>& trials) {
  const std::string heading =
      fmt::format("{}, seed {}: best until generation {}, {:.3f} d (eq 6)", experiment.name,
                  experiment.seed, best.generation, best.eq6);
  try {
    const Sheet sheet = individual_sheet(experiment, best.genome, trials(), heading);
    for (const char* name : {"best.svg", "best.png"}) {
      write_sheet(sheet, (directory_ / name).string(), Overwrite::yes);
    }
    failure_.clear();
  } catch (const std::exception& error) {
    failure_ = error.what();
  }
}

}  // namespace metamorph::evolve
