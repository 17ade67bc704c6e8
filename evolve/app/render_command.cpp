#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "evolve/app/commands.h"
#include "evolve/app/options.h"
#include "evolve/app/rules_options.h"
#include "evolve/app/subject.h"
#include "evolve/app/zoo.h"
#include "evolve/files/body_file.h"
#include "evolve/files/input_error.h"
#include "evolve/files/output_file.h"
#include "evolve/files/printable.h"
#include "evolve/run/pictures.h"
#include "evolve/study/field_of_run.h"
#include "evolve/view/field.h"
#include "evolve/view/motion.h"
#include "metamorph/extraction.h"

namespace metamorph::evolve {
namespace {

struct RenderOptions {
  std::vector<std::string> sources;
  std::string out;
  std::string kind = "animat";
  RulesOptions rules;
  int generation = -1;           ///< of a run; -1: the best of all
  std::vector<int> generations;  ///< of zoo and history; empty: `count`, evenly spread
  int count = 0;                 ///< 0: was not given
  int columns = 0;               ///< 0: was not given
  std::string colours;           ///< of zoo; empty: was not given
  int snapshots = 0;             ///< of motion; 0: was not given
  std::vector<int> at;           ///< empty: six steps
  double density = 2;
  bool overwrite = false;

  const std::string& source() const { return sources.front(); }
};

int snapshots_of(const RenderOptions& options) {
  return options.snapshots > 0 ? options.snapshots : 8;
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
        fmt::format("{}: the {} has no body that could move", options.source(), trial.name));
  }
  Sheet sheet = motion_of_body(extraction.body, subject.experiment.scene_of(trial),
                               locomotion_of(subject.experiment), snapshots_of(options));
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
  const core::Body body = read_body(options.source());
  Sheet sheet;
  if (options.kind == "development") {
    throw InputError("--kind: development: expected animat, motion or phase for a body");
  }
  if (options.kind == "motion") {
    const core::Scene scene = scene_of(experiment, options.rules);
    sheet = motion_of_body(body, scene, locomotion_of(experiment), snapshots_of(options));
    sheet.remark = fmt::format("last cycle, scene {}, time in steps", scene.name);
  } else if (options.kind == "phase") {
    sheet.legend = Legend::phase;
    sheet.rows = {{phase_panel(body)}};
  } else {
    sheet.rows = {{body_panel(body, {})}};
    sheet.remark = fmt::format("{} nodes, {} springs, {} triangles", body.node_count(),
                               body.springs.size(), body.triangles.size());
  }
  sheet.heading = stem_of(options.source());
  return sheet;
}

/// Throws InputError for an option that says nothing about this kind.
void check_of_kind(const RenderOptions& options) {
  const auto only = [&](const char* name, bool is_given, const std::string& kind) {
    if (is_given && options.kind != kind) {
      throw InputError(fmt::format("{}: not of --kind {}: expected {}", name, options.kind, kind));
    }
  };
  only("--at", !options.at.empty(), "development");
  only("--snapshots", options.snapshots > 0, "motion");
}

/// Throws InputError unless there is one source, and no option that is of many.
void check_one(const RenderOptions& options) {
  if (options.sources.size() > 1) {
    throw InputError(fmt::format("SOURCE: {} of them: expected one for --kind {} (zoo shows many)",
                                 options.sources.size(), options.kind));
  }
  for (const auto& [name, is_given] :
       {std::pair{"--generations", !options.generations.empty()},
        std::pair{"--count", options.count > 0}, std::pair{"--columns", options.columns > 0},
        std::pair{"--colours", !options.colours.empty()}}) {
    if (is_given) {
      throw InputError(
          fmt::format("{}: not of --kind {}: expected zoo or history", name, options.kind));
    }
  }
}

Sheet sheet_of_one(const RenderOptions& options) {
  check_one(options);
  const SourceKind kind = kind_of(options.source());
  check_options(kind, options.rules, options.generation >= 0 ? "--generation" : "");
  if (kind == SourceKind::body) return sheet_of_body(options);
  return sheet_of(kind == SourceKind::run
                      ? subject_of_run(RunReader(options.source()), options.generation)
                      : subject_of_genome(options.source(), options.rules),
                  options);
}

Sheet sheet_of_many(const RenderOptions& options) {
  ZooOptions zoo;
  zoo.sources = options.sources;
  zoo.rules = options.rules;
  zoo.generation = options.generation;
  zoo.generations = options.generations;
  zoo.count = options.count;
  if (options.columns > 0) zoo.style.columns = options.columns;
  const bool is_history = options.kind == "history";
  const bool shows_phase = options.colours.empty() ? is_history : options.colours == "phase";
  zoo.style.colours = shows_phase ? CellColours::phase : CellColours::birth;
  if (!is_history) return zoo_of(zoo);
  if (options.generation >= 0) {
    throw InputError("--generation: not of --kind history: expected --generations");
  }
  zoo.style.moving = false;
  return history_of(zoo);
}

Field field_of(const RenderOptions& options) {
  check_one(options);
  const SourceKind kind = kind_of(options.source());
  check_options(kind, options.rules, "");
  if (kind != SourceKind::run) {
    throw InputError(
        fmt::format("{}: expected a run for --kind {}", options.source(), options.kind));
  }
  if (options.generation >= 0) {
    throw InputError("--generation: not of --kind " + options.kind);
  }
  const RunReader run(options.source());
  return options.kind == "map" ? map_of(run) : front_of(run);
}

void render(const RenderOptions& options) {
  if (!is_picture_file(options.out)) {
    throw InputError("--out: " + options.out + ": expected a name that ends in .svg, .png or .pdf");
  }
  const Overwrite overwrite = options.overwrite ? Overwrite::yes : Overwrite::no;
  check_writable(options.out, overwrite);
  check_of_kind(options);
  if (options.kind == "map" || options.kind == "front") {
    const Field field = field_of(options);
    write_file(options.out, draw_field(field, options.out, options.density), overwrite);
    fmt::print("{}\n", printable(options.out));
    return;
  }
  const bool shows_many = options.kind == "zoo" || options.kind == "history";
  Sheet sheet = shows_many ? sheet_of_many(options) : sheet_of_one(options);
  sheet.density = options.density;
  write_sheet(sheet, options.out, overwrite);
  fmt::print("{}\n", printable(options.out));
}

}  // namespace

void add_render_command(CLI::App& app) {
  const auto options = std::make_shared<RenderOptions>();
  CLI::App* command =
      app.add_subcommand("render", "Draws champions of runs, genomes or bodies as SVG, PNG or PDF");
  command
      ->add_option("SOURCE", options->sources,
                   "Directory of a run or its run.db, a genome file, or a body file; several of "
                   "them with --kind zoo")
      ->required()
      ->option_text("RUN|GENOME.json|BODY.json...");
  command->add_option("--out", options->out, "The picture; its ending says which kind of file")
      ->required()
      ->option_text("FILE.svg|.png|.pdf");
  command
      ->add_option(
          "--kind", options->kind,
          "animat: embryos and bodies of all stages (figures 4, 5); development: a row of "
          "steps (figures 4, 8); motion: one cycle (figures 3, 6), from the body as it is "
          "also where a trial displaces it; phase: phase shifts (figure 9); zoo: many animats "
          "and where they move (figures 5, 7), those of several sources, or the best of "
          "some generations of a run; history: phase shifts of these (figure 19); map: the elites "
          "of a run of "
          "map-elites along its two axes; front: whom nobody dominates in a run of nsga2")
      ->check(
          one_of({"animat", "development", "motion", "phase", "zoo", "history", "map", "front"}))
      ->option_text("KIND [animat]");
  command->add_option("--generation", options->generation, "Of a run: the best of this generation")
      ->check(integer_from(0, 100000000))
      ->option_text("N [best of all]");
  command
      ->add_option("--generations", options->generations,
                   "Of zoo or history, and one run: the best of these, separated by commas")
      ->delimiter(',')
      ->option_text("N,...");
  command
      ->add_option("--count", options->count,
                   "Of the same: so many generations, evenly spread, if none are named")
      ->check(integer_from(1, most_animats))
      ->option_text("N [8]");
  command->add_option("--columns", options->columns, "Of zoo or history: animats in a row, at most")
      ->check(integer_from(1, most_animats))
      ->option_text("N [8]");
  command
      ->add_option("--colours", options->colours,
                   "Of zoo or history: what colours tell, the stage in which a cell was born or "
                   "its phase shift")
      ->check(one_of({"birth", "phase"}))
      ->option_text("birth|phase [birth; history: phase]");
  add_rules_options(*command, options->rules);
  add_trial_options(*command, options->rules);
  command->add_option("--at", options->at, "Of development: steps, separated by commas")
      ->delimiter(',')
      ->option_text("STEP,... [six]");
  command->add_option("--snapshots", options->snapshots, "Of motion: how many")
      ->check(integer_from(1, 64))
      ->option_text("N [8]");
  command
      ->add_option("--density", options->density,
                   "Of a PNG: pixels per unit of the page, which is about 1000 units wide")
      ->check(number_from(0.25, 8))
      ->option_text("X [2]");
  command->add_flag("--overwrite", options->overwrite, "Replace a file that exists");
  command->callback([options] { render(*options); });
}

}  // namespace metamorph::evolve
