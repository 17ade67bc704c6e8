#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "core/development/link_check.h"
#include "evolve/app/commands.h"
#include "evolve/app/json_line.h"
#include "evolve/app/options.h"
#include "evolve/app/rules_options.h"
#include "evolve/files/body_file.h"
#include "evolve/files/embryo_file.h"
#include "evolve/files/genome_file.h"
#include "evolve/files/input_error.h"
#include "evolve/files/output_file.h"
#include "evolve/files/printable.h"
#include "evolve/view/draw.h"
#include "metamorph/development.h"
#include "metamorph/extraction.h"

namespace metamorph::evolve {
namespace {

namespace fs = std::filesystem;

struct GrowOptions {
  std::string genome;
  RulesOptions rules;
  std::vector<int> at;  ///< empty: the stages of the experiment
  std::string out;      ///< empty: named after the genome
  std::string picture = "svg";
  bool overwrite = false;
  bool json = false;
  bool check_links = false;
};

/// One requested step: the state, its body and the files they go to.
struct Grown {
  core::Embryo embryo;
  core::Extraction extraction;
  fs::path embryo_file;
  fs::path body_file;  ///< written where there is a body
};

std::vector<Grown> grow(const Genome& genome, const Experiment& experiment,
                        const std::vector<int>& steps, const fs::path& out) {
  std::vector<Grown> result;
  for (core::Embryo& embryo : embryos_of(experiment, genome, steps)) {
    Grown grown;
    grown.extraction = core::extract_body(embryo, experiment.min_cells);
    grown.embryo_file = out / fmt::format("embryo-{:04}.json", embryo.step);
    grown.body_file = out / fmt::format("body-{:04}.json", embryo.step);
    grown.embryo = std::move(embryo);
    result.push_back(std::move(grown));
  }
  return result;
}

void draw(const std::vector<Grown>& all, const std::vector<int>& starts, const fs::path& file,
          Overwrite overwrite) {
  std::vector<core::Embryo> embryos;
  std::vector<core::Body> bodies;
  for (const Grown& grown : all) {
    embryos.push_back(grown.embryo);
    bodies.push_back(grown.extraction.body);
  }
  write_sheet(development_sheet(embryos, bodies, starts), file.string(), overwrite);
}

void print(const std::vector<Grown>& all, bool as_json) {
  if (!as_json)
    fmt::print("step  cells  created  died  body             nodes  springs  triangles  file\n");
  for (const Grown& grown : all) {
    const core::Embryo& embryo = grown.embryo;
    const core::Body& body = grown.extraction.body;
    const auto status = core::name(grown.extraction.status);
    if (!as_json) {
      fmt::print("{:<4}  {:>5}  {:>7}  {:>4}  {:<15}  {:>5}  {:>7}  {:>9}  {}\n", embryo.step,
                 embryo.cell_count(), embryo.created, embryo.died, status, body.node_count(),
                 body.springs.size(), body.triangles.size(), printable(grown.embryo_file.string()));
      continue;
    }
    nlohmann::ordered_json object = {{"step", embryo.step},
                                     {"status", status},
                                     {"embryo_cells", embryo.cell_count()},
                                     {"created", embryo.created},
                                     {"died", embryo.died},
                                     {"cells", body.node_count()},
                                     {"springs", body.springs.size()},
                                     {"triangles", body.triangles.size()},
                                     {"embryo_file", printable(grown.embryo_file.string())}};
    if (grown.extraction.status == core::Status::ok) {
      object["body_file"] = printable(grown.body_file.string());
    }
    fmt::print("{}\n", json_line(object));
  }
}

void grow_command(const GrowOptions& options) {
  const Experiment experiment = experiment_of(options.rules);
  const Genome genome = read_genome(options.genome, experiment.development);
  const fs::path out =
      options.out.empty() ? fs::path(options.genome).stem() : fs::path(options.out);
  const std::vector<int> steps =
      steps_at(experiment, options.at.empty() ? experiment.stages() : options.at);
  core::LinkCheck check;
  if (options.check_links) {
    const std::vector<core::Network> life = networks_of(experiment, genome);
    check =
        core::check_links({&life, 1}, experiment.metamorphoses(), experiment.development, steps, 1)
            .front();
  }
  if (!check.ok()) throw std::runtime_error(options.genome + ": " + difference_text(check));
  const std::vector<Grown> all = grow(genome, experiment, steps, out);
  const fs::path picture = out / ("development." + options.picture);
  const bool with_picture = options.picture != "none";

  std::error_code error;
  fs::create_directories(out, error);
  if (error || !fs::is_directory(out)) {
    throw InputError(out.string() + ": " + (error ? error.message() : "not a directory") +
                     ": expected a directory that can be written");
  }
  // Everything is asked before anything is written.
  const Overwrite overwrite = options.overwrite ? Overwrite::yes : Overwrite::no;
  std::vector<fs::path> files;
  for (const Grown& grown : all) {
    files.push_back(grown.embryo_file);
    if (grown.extraction.status == core::Status::ok) files.push_back(grown.body_file);
  }
  if (with_picture) files.push_back(picture);
  std::vector<std::string> faults;
  for (const fs::path& file : files) {
    try {
      check_writable(file, overwrite);
    } catch (const InputError& fault) {
      faults.insert(faults.end(), fault.lines().begin(), fault.lines().end());
    }
  }
  if (!faults.empty()) throw InputError(faults);

  for (const Grown& grown : all) {
    write_embryo(grown.embryo_file, grown.embryo, grown.extraction, overwrite);
    if (grown.extraction.status == core::Status::ok) {
      write_body(grown.body_file, grown.extraction.body, overwrite);
    }
  }
  if (with_picture) draw(all, experiment.metamorphoses(), picture, overwrite);
  print(all, options.json);
  if (with_picture && !options.json) fmt::print("picture: {}\n", printable(picture.string()));
  if (options.check_links && !options.json) {
    fmt::print("{} links at {} renewals: all as a full triangulation has them\n", check.links,
               check.renewals);
  }
}

}  // namespace

void add_grow_command(CLI::App& app) {
  const auto options = std::make_shared<GrowOptions>();
  CLI::App* command = app.add_subcommand(
      "grow", "Develops one genome; writes embryos, bodies and a picture at chosen steps");
  command->add_option("GENOME", options->genome, "Genome file (metamorph-genome/1)")
      ->required()
      ->option_text("GENOME.json");
  command->add_option("--at", options->at, "Steps to write, separated by commas")
      ->delimiter(',')
      ->option_text("STEP,... [the stages of the experiment]");
  command
      ->add_option("--out", options->out,
                   "Directory for embryo-STEP.json, body-STEP.json and the picture")
      ->option_text("DIRECTORY [named after the genome]");
  command->add_option("--picture", options->picture, "Kind of picture")
      ->check(one_of({"svg", "png", "pdf", "none"}))
      ->option_text("svg|png|pdf|none [svg]");
  add_rules_options(*command, options->rules);
  command->add_flag("--overwrite", options->overwrite, "Replace files that exist");
  command->add_flag("--json", options->json, "Print one JSON object per step instead of a table");
  command->add_flag("--check-links", options->check_links,
                    "For debugging: triangulate anew at every renewal of the cells' neighbours, "
                    "and fail at the first link that differs");
  command->callback([options] { grow_command(*options); });
}

}  // namespace metamorph::evolve
