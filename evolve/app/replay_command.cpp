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
#include "evolve/app/streams.h"
#include "evolve/app/subject.h"
#include "evolve/files/input_error.h"
#include "evolve/files/output_file.h"
#include "evolve/files/printable.h"
#include "evolve/replay/page.h"
#include "evolve/run/run_reader.h"

namespace metamorph::evolve {
namespace {

struct ReplayOptions {
  LifeSources sources;
  LifeOptions life;
  std::string out;
  bool overwrite = false;
};

/// A word as a shell reads it back.
std::string quoted(const std::string& word) {
  constexpr std::string_view plain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-+./,:=@%";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string result = "'";
  for (const char c : word) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return printable(result + "'");
}

/// The command that made the page, with the options that were given.
std::string command_of(const ReplayOptions& options) {
  std::string text = "metamorph replay";
  const auto add = [&](const std::string& option, const std::string& value) {
    text.append(" ").append(option).append(" ").append(quoted(value));
  };
  for (const std::string& source : options.sources.sources) text += " " + quoted(source);
  add("--out", options.out);
  const LifeSources& sources = options.sources;
  if (!sources.generations.empty()) {
    add("--generations", fmt::format("{}", fmt::join(sources.generations, ",")));
  }
  if (sources.every > 0) add("--every-generation", std::to_string(sources.every));
  if (!sources.rules.experiment.empty()) add("--experiment", sources.rules.experiment);
  for (const std::string& set : sources.rules.set) add("--set", set);
  if (!sources.rules.scene.empty()) add("--scene", sources.rules.scene);
  if (options.life.copies > 0) add("--copies", std::to_string(options.life.copies));
  if (options.life.reference) text += " --reference";
  return text;
}

/// The lives of a run, and what the page tells of it.
RunInPage add_run(const std::string& source, int number, const LifeSources& only,
                  const LifeOptions& options, const std::function<void(Life, PlaceInRun)>& add) {
  const RunReader run(source);
  std::vector<std::int64_t> individuals;
  each_life(only, options, [&](Life life) {
    const Champion champion = run.champion(life.generation);
    individuals.push_back(champion.individual);
    add(std::move(life), {number, champion.individual, champion.eq6});
  });
  const Experiment experiment = run.experiment();
  return {fmt::format("{}, seed {}", experiment.name, experiment.seed), run.fitness(),
          run.ancestors(individuals)};
}

void replay(const ReplayOptions& options) {
  const std::filesystem::path out(options.out);
  if (out.extension() != ".html") {
    throw InputError("--out: " + options.out + ": expected a name that ends in .html");
  }
  const std::vector<std::string>& sources = options.sources.sources;
  PageWriter page(out, options.overwrite ? Overwrite::yes : Overwrite::no,
                  printable(std::filesystem::path(sources.front()).lexically_normal().string()),
                  command_of(options));
  int lives = 0;
  const auto add = [&](const Life& life, const PlaceInRun& place) {
    tell("{}\n", life.heading);
    for (const Motion& motion : life.motions) {
      if (motion.status == core::Status::ok) continue;
      tell("{}: the {} has no body ({})\n", life.heading, motion.name, core::name(motion.status));
    }
    page.add(life, place);
    ++lives;
  };
  std::vector<RunInPage> runs;
  for (const std::string& source : sources) {
    LifeSources only = options.sources;
    only.sources = {source};
    if (kind_of(source) == SourceKind::run) {
      runs.push_back(add_run(source, static_cast<int>(runs.size()), only, options.life, add));
    } else {
      each_life(only, options.life, [&](Life life) { add(life, {}); });
    }
  }
  page.finish(runs);
  fmt::print("{}: {} animat{}, {:.0f} kB\n", printable(options.out), lives, lives == 1 ? "" : "s",
             static_cast<double>(page.bytes()) / 1000);
}

}  // namespace

void add_replay_command(CLI::App& app) {
  const auto options = std::make_shared<ReplayOptions>();
  CLI::App* command = app.add_subcommand(
      "replay", "Makes a page that plays lives from the egg on, in any browser and offline");
  add_life_sources(*command, options->sources);
  command->add_option("--out", options->out, "The page, one file")
      ->required()
      ->option_text("FILE.html");
  command
      ->add_option("--copies", options->life.copies,
                   "Shows so many other starts beside each: those of its trial, else starts 1e-3 d "
                   "away")
      ->check(integer_from(0, 100))
      ->option_text("N [0]");
  command->add_flag("--reference", options->life.reference,
                    "Shows the float64 reference at a quarter of the step as a ghost (slow)");
  command->add_option("--threads", options->life.threads, "Threads of the simulation; 0: all")
      ->check(integer_from(0, 100000))
      ->option_text("N [0]");
  command->add_flag("--overwrite", options->overwrite, "Replace a file that exists");
  command->callback([options] { replay(*options); });
}

}  // namespace metamorph::evolve
