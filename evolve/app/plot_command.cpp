#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "evolve/app/commands.h"
#include "evolve/app/options.h"
#include "evolve/app/streams.h"
#include "evolve/files/input_error.h"
#include "evolve/files/output_file.h"
#include "evolve/files/printable.h"
#include "evolve/study/curves.h"
#include "evolve/study/figure.h"
#include "evolve/view/canvas.h"
#include "evolve/view/chart.h"

namespace metamorph::evolve {
namespace {

struct Arguments {
  std::vector<std::string> runs;
  std::string kind, out, csv;
  std::string centre = "mean";
  std::vector<std::string> curves;
  std::string title;
  bool overwrite = false;
};

bool is_csv(const std::string& file) { return file.ends_with(".csv"); }

void check_names(const Arguments& given, Overwrite overwrite) {
  if (!is_csv(given.out) && !is_picture_file(given.out)) {
    throw InputError("--out: " + given.out +
                     ": expected a name that ends in .svg, .png, .pdf or .csv");
  }
  check_writable(given.out, overwrite);
  if (given.csv.empty()) return;
  if (!is_csv(given.csv)) {
    throw InputError("--csv: " + given.csv + ": expected a name that ends in .csv");
  }
  if (is_csv(given.out)) {
    throw InputError("--csv: " + given.csv + ": expected a picture as --out, not a .csv as well");
  }
  check_writable(given.csv, overwrite);
}

void plot(const Arguments& given) {
  const Overwrite overwrite = given.overwrite ? Overwrite::yes : Overwrite::no;
  check_names(given, overwrite);
  const std::vector<PlotKind>& kinds = plot_kinds();
  const PlotKind& kind = *std::find_if(kinds.begin(), kinds.end(),
                                       [&](const PlotKind& k) { return k.name == given.kind; });
  const Centre centre = given.centre == "median" ? Centre::median : Centre::mean;
  const std::vector<std::filesystem::path> runs(given.runs.begin(), given.runs.end());
  const Study study = study_of(runs, kind, centre, given.curves);
  for (const std::string& note : study.notes) tell("note: {}\n", note);
  if (is_csv(given.out)) {
    write_file(given.out, csv_of(study), overwrite);
  } else {
    Chart chart = figure_of(study, kind, centre);
    if (!given.title.empty()) chart.heading = printable(given.title);
    write_file(given.out, draw_chart(chart, given.out), overwrite);
  }
  fmt::print("{}\n", printable(given.out));
  if (given.csv.empty()) return;
  write_file(given.csv, csv_of(study), overwrite);
  fmt::print("{}\n", printable(given.csv));
}

std::string kinds_help() {
  std::string help = "What is drawn, with the names that --curves takes.";
  for (const PlotKind& kind : plot_kinds()) help += fmt::format(" {}: {}.", kind.name, kind.help);
  return help;
}

}  // namespace

void add_plot_command(CLI::App& app) {
  auto given = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "plot", "Draws what runs did over their generations, as SVG, PNG, PDF or CSV");
  command
      ->add_option("RUN", given->runs,
                   "Directories of runs or their run.db. Runs that differ in their seed alone are "
                   "one experiment: its curve is their mean or median, around it the 95 % band of "
                   "the percentile bootstrap over runs; of one run there is no band. Experiments "
                   "have a colour each; their trials are matched by name, or by scene where names "
                   "differ. A curve goes as far as all of its runs do")
      ->required()
      ->option_text("RUN...");
  std::vector<std::string> names;
  for (const PlotKind& kind : plot_kinds()) names.emplace_back(kind.name);
  command->add_option("--kind", given->kind, kinds_help())
      ->required()
      ->check(one_of(names))
      ->option_text("KIND");
  command
      ->add_option(
          "--out", given->out,
          "The picture, or with .csv the numbers behind it: experiment, curve, generation, "
          "centre, low, high, runs")
      ->required()
      ->option_text("FILE.svg|.png|.pdf|.csv");
  command->add_option("--csv", given->csv, "The numbers too, beside the picture")
      ->option_text("FILE.csv");
  command->add_option("--centre", given->centre, "Of the runs")
      ->check(one_of({"mean", "median"}))
      ->option_text("mean|median [mean]");
  command->add_option("--curves", given->curves, "Some of the kind's curves, separated by commas")
      ->delimiter(',')
      ->option_text("NAME,... [all]");
  command->add_option("--title", given->title, "Heading of the picture")
      ->option_text("TEXT [by kind]");
  command->add_flag("--overwrite", given->overwrite, "Replace a file that exists");
  command->callback([given] { plot(*given); });
}

}  // namespace metamorph::evolve
