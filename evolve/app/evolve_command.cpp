#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <csignal>
#include <cstring>
#include <memory>

#include "evolve/app/commands.h"
#include "evolve/app/progress.h"
#include "evolve/app/streams.h"
#include "evolve/experiment/experiment_file.h"
#include "evolve/files/input_error.h"
#include "evolve/run/memory_check.h"
#include "evolve/run/pictures.h"
#include "evolve/run/run.h"
#include "evolve/run/shared_disk.h"

namespace metamorph::evolve {
namespace {

struct Arguments {
  std::string experiment, out, resume;
  std::string seed, generations, population;  // as text: the key table checks them like a file's
  int threads = 0;
  std::vector<std::string> set;
  bool keys = false;
  bool print = false;
  bool check_links = false;
};

volatile std::sig_atomic_t interrupts = 0;

/// The first signal asks the run to stop after its generation; the second ends the program at once.
/// The record needs no farewell: whatever was committed is safe.
void on_signal(int) {
  interrupts = interrupts + 1;
  if (interrupts == 1) {
    constexpr char text[] = "\nfinishing this generation; once more stops at once\n";
    [[maybe_unused]] const auto written = write(STDERR_FILENO, text, sizeof text - 1);
    return;
  }
  _exit(130);
}

void handle_signals() {
  struct sigaction action{};
  action.sa_handler = on_signal;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before{};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);  // nohup stays nohup
  }
  ignore_broken_pipes();  // whoever no longer reads the progress is no reason to stop
}

std::vector<Override> overrides_of(const Arguments& given) {
  std::vector<Override> overrides;
  for (const std::string& text : given.set) overrides.push_back(parse_override(text));
  const auto add = [&](const char* option, const char* key, const std::string& value) {
    if (!value.empty()) overrides.push_back({option, key, value});
  };
  add("--generations", "generations", given.generations);
  add("--seed", "seed", given.seed);
  add("--population", "neat.population", given.population);
  return overrides;
}

/// runs/<experiment>-seed<seed>, or the first of -2, -3, ... that does not exist.
std::filesystem::path default_directory(const Experiment& experiment) {
  const std::string base = fmt::format("runs/{}-seed{}", experiment.name, experiment.seed);
  std::string name = base;
  for (int n = 2; std::filesystem::exists(name); ++n) name = fmt::format("{}-{}", base, n);
  return name;
}

std::unique_ptr<Record> open_record(const Arguments& given) {
  if (given.resume.empty()) {
    const Experiment experiment = read_experiment(given.experiment, overrides_of(given));
    require_memory(experiment, given.threads);
    const SearchSetup setup = search_setup_of(experiment, given.threads);
    if (const auto notes = search_kind(experiment.search.kind).notes; notes != nullptr) {
      for (const std::string& note : notes(setup)) tell("note: {}\n", note);
    }
    return std::make_unique<Record>(
        given.out.empty() ? default_directory(experiment) : std::filesystem::path(given.out),
        experiment, given.threads);
  }
  int generations = 0, recorded_generations = 0;
  std::unique_ptr<Record> record =
      Record::resume(given.resume, given.threads, [&](Record& accepted) {
        const Experiment recorded = accepted.experiment();
        require_memory(recorded, given.threads);
        generations = recorded_generations = recorded.generations;
        if (given.generations.empty()) return;
        // Through the same checks as every other way to give the number.
        generations = parse_experiment(to_toml(recorded), given.resume,
                                       {{"--generations", "generations", given.generations}})
                          .generations;
        check_new_generations(recorded, accepted.generations_done(), generations);
      });
  if (generations != recorded_generations) record->change_generations(generations);
  return record;
}

void check_combination(const Arguments& given) {
  if (given.resume.empty()) {
    if (given.experiment.empty()) {
      throw InputError("evolve: expected an experiment file, or --resume DIR (see evolve --help)");
    }
    return;
  }
  std::vector<std::string> faults;
  const auto refuse = [&](const char* what, bool is_given) {
    if (is_given) {
      faults.push_back(fmt::format(
          "{}: not together with --resume, which goes on with the run as it was recorded", what));
    }
  };
  refuse("EXPERIMENT", !given.experiment.empty());
  refuse("--out", !given.out.empty());
  refuse("--seed", !given.seed.empty());
  refuse("--population", !given.population.empty());
  refuse("--set", !given.set.empty());
  refuse("--print", given.print);
  if (!faults.empty()) throw InputError(faults);
}

void evolve(const Arguments& given) {
  if (given.keys) {
    fmt::print("{}", describe_keys());
    return;
  }
  check_combination(given);
  if (given.print) {
    fmt::print("{}", to_toml(read_experiment(given.experiment, overrides_of(given))));
    return;
  }
  handle_signals();
  const std::unique_ptr<Record> record = open_record(given);
  if (const auto disk = shared_disk_of(record->directory())) {
    tell("note: {} lies on {}, which machines share: the record has a rollback journal\n",
         record->directory().string(), *disk);
  }
  Progress progress(isatty(STDERR_FILENO) == 1);
  PictureReporter pictures;
  CheckedLinks checked;
  const RunSummary summary = run(*record, {given.threads,
                                           [] { return interrupts > 0; },
                                           {&pictures, &progress},
                                           given.check_links ? &checked : nullptr});
  if (!pictures.failure().empty()) {
    tell("no picture of the best: {}\n", pictures.failure());
  }
  if (given.check_links) {
    fmt::print("{} links at {} renewals of {} developments: all as a full triangulation has them\n",
               checked.links, checked.renewals, checked.developments);
  }
  const std::string directory = record->directory().string();
  record->close();  // before anything is promised
  if (summary.interrupted) {
    fmt::print("stopped after {} generations; go on with: metamorph evolve --resume {}\n",
               summary.generations_done, directory);
  } else {
    fmt::print("best: {:.4f} d (eq 6) in generation {}; recorded in {}\n", summary.best.eq6,
               summary.best.generation, directory);
  }
}

}  // namespace

void add_evolve_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("evolve", "Runs an experiment, or goes on with a run");
  auto given = std::make_shared<Arguments>();
  command->add_option("EXPERIMENT", given->experiment,
                      "experiment file (TOML); evolve/experiments/ holds those of the paper");
  command->add_option("--out", given->out,
                      "directory of the run; default runs/<experiment>-seed<seed>[-n]");
  command->add_option(
      "--resume", given->resume,
      "go on with the run in this directory, to the same bits as one never stopped; "
      "--generations may ask for more");
  command->add_option("--seed", given->seed, "seed of all random numbers");
  command->add_option("--generations", given->generations, "generations to evolve");
  command->add_option("--population", given->population, "individuals per generation");
  command
      ->add_option("--threads", given->threads,
                   "threads; default: all. Results do not depend on it")
      ->check(CLI::Range(1, 4096));
  command
      ->add_option(
          "--set", given->set,
          "key=value: replaces any key of the file (may be repeated), as in search.neighbours=10, "
          "trials.larva.stage=500, scenes.water.drag_normal=2, scenes.*.run_steps=600")
      ->allow_extra_args(false);
  command->add_flag("--keys", given->keys, "lists all keys with default, meaning and range");
  command->add_flag("--print", given->print,
                    "prints the complete experiment as TOML instead of running it");
  command->add_flag("--check-links", given->check_links,
                    "for debugging: triangulates anew at every renewal of the cells' neighbours, "
                    "and stops at the first link that differs; the run and its record stay the "
                    "same");
  command->callback([given] { evolve(*given); });
}

}  // namespace metamorph::evolve
