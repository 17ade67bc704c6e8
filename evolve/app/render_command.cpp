#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "evolve/app/commands.h"
#include "evolve/app/life_sources.h"
#include "evolve/app/options.h"
#include "evolve/app/rules_options.h"
#include "evolve/files/animat_file.h"
#include "evolve/files/body_file.h"
#include "evolve/files/genome_file.h"
#include "evolve/files/input_error.h"
#include "evolve/files/output_file.h"
#include "evolve/files/printable.h"
#include "evolve/run/pictures.h"
#include "evolve/run/run_reader.h"
#include "evolve/view/motion.h"
#include "metamorph/extraction.h"

namespace metamorph::evolve {
namespace {

struct RenderOptions {
  std::string source;
  std::string out;
  std::string kind = "animat";
  RulesOptions rules;
  int generation = -1;  ///< of a run; -1: the best of all
  int snapshots = 8;
  std::vector<int> at;  ///< empty: six steps
  bool overwrite = false;
};

/// A genome and the experiment it is shown in.
struct Subject {
  Experiment experiment;
  Genome genome;
  std::string heading;
  int generation = 0;  ///< whose starts the outcomes shown are of
};

Subject subject_of_run(const RenderOptions& options) {
  const RunReader run(options.source);
  if (run.generations_done() == 0) throw InputError(options.source + ": no generation is done yet");
  Subject subject{run.experiment(), {}, ""};
  const Champion champion = options.generation >= 0 ? run.champion(options.generation) : run.best();
  subject.genome = champion.genome;
  subject.generation = champion.generation;
  subject.heading =
      fmt::format("{}, seed {}: best of generation {}, {:.3f} d (eq 6)", subject.experiment.name,
                  subject.experiment.seed, champion.generation, champion.eq6);
  return subject;
}

/// The name of a file as a heading.
std::string stem_of(const std::string& file) {
  return printable(std::filesystem::path(file).stem().string());
}

Subject subject_of_genome(const RenderOptions& options) {
  Experiment experiment = experiment_of(options.rules);
  Genome genome = read_genome(options.source, experiment.development);
  return {std::move(experiment), std::move(genome), stem_of(options.source)};
}

std::vector<core::Outcome> outcomes_of(const Subject& subject) {
  return Evaluator(rules_of(subject.experiment), 1)
      .evaluate_fully(networks_of(subject.experiment, subject.genome), subject.generation)
      .trials;
}

std::vector<core::Embryo> embryos_of(const Subject& subject, const std::vector<int>& steps) {
  return embryos_of(subject.experiment, subject.genome, steps);
}

/// Six steps, evenly spread to the end.
std::vector<int> six_steps(int end) {
  std::vector<int> steps;
  for (int k = 1; k <= 6; ++k) steps.push_back(end * k / 6);
  return steps;
}

Sheet development_of(const Subject& subject, const RenderOptions& options) {
  const Experiment& experiment = subject.experiment;
  const std::vector<core::Embryo> embryos = embryos_of(
      subject, steps_at(experiment,
                        options.at.empty() ? six_steps(experiment.development.steps) : options.at));
  std::vector<core::Body> bodies;
  for (const core::Embryo& embryo : embryos) {
    bodies.push_back(core::extract_body(embryo, experiment.min_cells).body);
  }
  return development_sheet(embryos, bodies, experiment.metamorphoses());
}

Sheet motion_of_body(const core::Body& body, const core::Scene& scene,
                     const core::LocomotionOptions& locomotion, int count) {
  return motion_sheet(body, last_cycle(body, scene, locomotion, count), core::shows_ground(scene));
}

Sheet motion_of(const Subject& subject, const RenderOptions& options) {
  const Trial* named = trial_of(subject.experiment, options.rules);
  const Trial& trial = named == nullptr ? subject.experiment.trials.front() : *named;
  const core::Embryo embryo = embryos_of(subject, {trial.stage}).front();
  const core::Extraction extraction = core::extract_body(embryo, subject.experiment.min_cells);
  if (extraction.status != core::Status::ok) {
    throw InputError(
        fmt::format("{}: the {} has no body that could move", options.source, trial.name));
  }
  Sheet sheet = motion_of_body(extraction.body, subject.experiment.scene_of(trial),
                               locomotion_of(subject.experiment), options.snapshots);
  sheet.remark = fmt::format("{}: last cycle, scene {}, time in steps", trial.name, trial.scene);
  return sheet;
}

Sheet phases_of(const Subject& subject) {
  std::vector<Stage> stages;
  for (const Trial& trial : subject.experiment.trials) {
    Stage stage;
    stage.title = trial.name;
    stage.embryo = embryos_of(subject, {trial.stage}).front();
    stage.body = core::extract_body(stage.embryo, subject.experiment.min_cells).body;
    stages.push_back(std::move(stage));
  }
  return phase_sheet(stages);
}

Sheet sheet_of(const Subject& subject, const RenderOptions& options) {
  Sheet sheet;
  if (options.kind == "animat") {
    return individual_sheet(subject.experiment, subject.genome, outcomes_of(subject),
                            subject.heading);
  }
  if (options.kind == "development") sheet = development_of(subject, options);
  if (options.kind == "motion") sheet = motion_of(subject, options);
  if (options.kind == "phase") sheet = phases_of(subject);
  sheet.heading = subject.heading;
  return sheet;
}

Sheet sheet_of_body(const RenderOptions& options) {
  const Experiment experiment = experiment_of(options.rules);
  const core::Body body = read_body(options.source);
  Sheet sheet;
  if (options.kind == "development") {
    throw InputError("--kind: development: expected animat, motion or phase for a body");
  }
  if (options.kind == "motion") {
    const core::Scene scene = scene_of(experiment, options.rules);
    sheet = motion_of_body(body, scene, locomotion_of(experiment), options.snapshots);
    sheet.remark = fmt::format("last cycle, scene {}, time in steps", scene.name);
  } else if (options.kind == "phase") {
    sheet.legend = Legend::phase;
    sheet.rows = {{phase_panel(body)}};
  } else {
    sheet.rows = {{body_panel(body, {})}};
    sheet.remark = fmt::format("{} nodes, {} springs, {} triangles", body.node_count(),
                               body.springs.size(), body.triangles.size());
  }
  sheet.heading = stem_of(options.source);
  return sheet;
}

/// Options that say nothing about such a source; each gets its line.
void refuse(const std::vector<std::pair<const char*, bool>>& options, const std::string& why) {
  std::vector<std::string> faults;
  for (const auto& [name, is_given] : options) {
    if (is_given) faults.push_back(fmt::format("{}: {}", name, why));
  }
  if (!faults.empty()) throw InputError(faults);
}

void render(const RenderOptions& options) {
  if (!is_picture_file(options.out)) {
    throw InputError("--out: " + options.out + ": expected a name that ends in .svg, .png or .pdf");
  }
  const Overwrite overwrite = options.overwrite ? Overwrite::yes : Overwrite::no;
  check_writable(options.out, overwrite);
  Sheet sheet;
  const RulesOptions& rules = options.rules;
  if (is_run(options.source)) {
    refuse({{"--experiment", !rules.experiment.empty()},
            {"--set", !rules.set.empty()},
            {"--scene", !rules.scene.empty()}},
           "not together with a run, which is shown by its own rules");
    sheet = sheet_of(subject_of_run(options), options);
  } else if (format_of(std::filesystem::path(options.source)) == body_format) {
    refuse({{"--generation", options.generation >= 0}}, "expected a run, not a body");
    sheet = sheet_of_body(options);
  } else {
    refuse({{"--generation", options.generation >= 0}}, "expected a run, not a genome");
    refuse({{"--scene", !rules.scene.empty()}},
           "expected a body: a genome moves in the scene of its trial (--trial)");
    sheet = sheet_of(subject_of_genome(options), options);
  }
  write_sheet(sheet, options.out, overwrite);
  fmt::print("{}\n", printable(options.out));
}

}  // namespace

void add_render_command(CLI::App& app) {
  const auto options = std::make_shared<RenderOptions>();
  CLI::App* command =
      app.add_subcommand("render", "Draws a run's champion, a genome or a body as SVG, PNG or PDF");
  command
      ->add_option("SOURCE", options->source,
                   "Directory of a run or its run.db, a genome file, or a body file")
      ->required()
      ->option_text("RUN|GENOME.json|BODY.json");
  command->add_option("--out", options->out, "The picture; its ending says which kind of file")
      ->required()
      ->option_text("FILE.svg|.png|.pdf");
  command
      ->add_option("--kind", options->kind,
                   "animat: embryos and bodies of all stages (figures 4, 5); development: a row of "
                   "steps (figures 4, 8); motion: one cycle (figures 3, 6), from the body as it is "
                   "also where a trial displaces it; phase: phase shifts (figure 9)")
      ->check(one_of({"animat", "development", "motion", "phase"}))
      ->option_text("KIND [animat]");
  command->add_option("--generation", options->generation, "Of a run: the best of this generation")
      ->check(integer_from(0, 100000000))
      ->option_text("N [best of all]");
  add_rules_options(*command, options->rules);
  add_trial_options(*command, options->rules);
  command->add_option("--at", options->at, "Of development: steps, separated by commas")
      ->delimiter(',')
      ->option_text("STEP,... [six]");
  command->add_option("--snapshots", options->snapshots, "Of motion: how many")
      ->check(integer_from(1, 64))
      ->option_text("N [8]");
  command->add_flag("--overwrite", options->overwrite, "Replace a file that exists");
  command->callback([options] { render(*options); });
}

}  // namespace metamorph::evolve
