#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "evolve/app/commands.h"
#include "evolve/app/json_line.h"
#include "evolve/app/text.h"
#include "evolve/experiment/keys.h"
#include "evolve/files/printable.h"
#include "evolve/run/run_reader.h"
#include "metamorph/status.h"

namespace metamorph::evolve {
namespace {

void add_health(nlohmann::ordered_json& json, const SearchHealth& health) {
  if (health.species) {
    json["species"] = {{"now", *health.species}, {"founded", health.founded}};
    for (const auto& [why, count] : health.ended) json["species"]["ended"][why] = count;
  }
  for (const auto& [origin, children, better, dead] : health.origins) {
    json["origins"][origin] = {{"children", children}, {"better", better}, {"dead", dead}};
  }
  if (const auto& archive = health.archive) {
    json["archive"] = {
        {"size", archive->size}, {"threshold", archive->threshold}, {"copies", archive->copies}};
  }
  if (const auto& map = health.map) {
    json["map"] = {{"filled", map->filled}, {"niches", map->niches}, {"qd_score", map->qd_score}};
  }
  if (const auto& front = health.front) {
    json["front"] = {{"size", front->size}, {"hypervolume", front->hypervolume}};
  }
  for (const auto& [trial, share] : health.behaviour) json["behaviour_shares"][trial] = share;
}

void print_health(const SearchHealth& health) {
  if (health.species) {
    fmt::print("species      {} now, {} founded", *health.species, health.founded);
    for (const auto& [why, count] : health.ended) fmt::print(", {} {}", count, why);
    fmt::print("\n");
  }
  if (!health.origins.empty()) {
    fmt::print("children     of the last {} generations, better than both parents / dead:\n",
               SearchHealth::recent);
  }
  for (const auto& [origin, children, better, dead] : health.origins) {
    const auto percent = [all = children](std::int64_t part) {
      return 100.0 * static_cast<double>(part) / static_cast<double>(all);
    };
    fmt::print("  {:<11}{:>6}  {:4.1f} % / {:4.1f} %\n", origin, children, percent(better),
               percent(dead));
  }
  if (const auto& archive = health.archive) {
    fmt::print("archive      {} behaviours, threshold {:.3g} d, {} copies met\n", archive->size,
               archive->threshold, archive->copies);
  }
  if (const auto& map = health.map) {
    fmt::print("map          {} of {} niches filled, QD score {:.6g}\n", map->filled, map->niches,
               map->qd_score);
  }
  if (const auto& front = health.front) {
    fmt::print("front        {} that nobody dominates, hypervolume {:.6g}\n", front->size,
               front->hypervolume);
  }
  if (!health.behaviour.empty()) {
    fmt::print("behaviour    variance");
    for (std::size_t t = 0; t < health.behaviour.size(); ++t) {
      fmt::print("{} {} {:.0f} %", t == 0 ? "" : ",", health.behaviour[t].first,
                 100 * health.behaviour[t].second);
    }
    fmt::print("\n");
  }
}

void print_json(const RunReader& run, const Experiment& experiment) {
  nlohmann::ordered_json json;
  json["run"] = printable(run.file().string());
  json["experiment"] = experiment.name;
  json["seed"] = experiment.seed;
  json["generations"] = run.generations_done();
  json["generations_planned"] = experiment.generations;
  json["population"] = experiment.neat.population;
  if (run.generations_done() > 0) {
    const Champion best = run.best();
    auto& entry = json["best"];
    entry["generation"] = best.generation;
    entry["individual"] = best.individual;
    entry["eq6"] = best.eq6;
    for (std::size_t t = 0; t < experiment.trials.size(); ++t) {
      auto& trial = entry["trials"].emplace_back();
      trial["name"] = experiment.trials[t].name;
      trial["status"] = best.statuses[t];
      trial["distance"] = best.distances[t];
    }
  }
  json["status"] = run.status_counts();
  for (const auto& [phase, seconds] : run.phase_seconds()) json["seconds"][phase] = seconds;
  const EvaluationWork work = run.work();
  json["work"] = {{"individuals", work.individuals},
                  {"developed", work.developed},
                  {"bodies", work.bodies},
                  {"simulated", work.simulated}};
  add_health(json, run.health());
  for (const auto& [key, value] : run.last_session()) json["session"][key] = value;
  fmt::print("{}\n", json_line(json));
}

/// How a trial's starts count, where they are not one body as it is.
std::string starts_text(const Trial& trial) {
  if (trial.starts == 1) {
    if (!trial.starts_renew) return "";
    return fmt::format(", a start within {} d, another one in every generation",
                       trial.start_displacement);
  }
  return fmt::format(", {} of {} starts within {} d{}", name(trial.starts_combine), trial.starts,
                     trial.start_displacement,
                     trial.starts_renew ? ", other ones in every generation" : "");
}

void print_text(const RunReader& run, const Experiment& experiment) {
  const int done = run.generations_done();
  fmt::print("{}\n", printable(run.file().string()));
  fmt::print("experiment   {}, seed {}\n", experiment.name, experiment.seed);
  for (const Trial& trial : experiment.trials) {
    fmt::print("trial        {}: {} at step {}{}\n", trial.name, trial.scene, trial.stage,
               starts_text(trial));
  }
  fmt::print("generations  {} of {}, {} individuals each\n", done, experiment.generations,
             experiment.neat.population);
  if (done > 0) {
    const Champion best = run.best();
    fmt::print("best         {:.4f} d (eq 6) in generation {}:", best.eq6, best.generation);
    for (std::size_t t = 0; t < experiment.trials.size(); ++t) {
      fmt::print("{} {} {:.4f} d", t == 0 ? "" : ",", experiment.trials[t].name, best.distances[t]);
    }
    fmt::print("\n");
    std::int64_t all = 0;
    const auto counts = run.status_counts();
    for (const auto& [status, count] : counts) all += count;
    fmt::print("evaluations  {}", all);
    for (const core::Status status : core::all_statuses) {
      const auto found = counts.find(std::string(core::name(status)));
      if (found != counts.end()) {
        fmt::print(", {} {} ({:.1f} %)", found->first, found->second,
                   100.0 * static_cast<double>(found->second) / static_cast<double>(all));
      }
    }
    if (const std::string saved = saved_text(run.work()); !saved.empty()) {
      fmt::print("\nknown        {}", saved);
    }
    double total = 0;
    for (const auto& [phase, seconds] : run.phase_seconds()) total += seconds;
    fmt::print("\ntime         {}", duration_text(total));
    for (const auto& [phase, seconds] : run.phase_seconds()) {
      fmt::print(", {} {:.1f} %", phase, 100 * seconds / total);
    }
    fmt::print("\n");
    print_health(run.health());
  }
  for (const auto& [key, value] : run.last_session()) fmt::print("{:<12} {}\n", key, value);
}

}  // namespace

void add_info_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("info", "Says what is in a run");
  struct Arguments {
    std::string run;
    bool json = false;
    bool verify = false;
  };
  auto given = std::make_shared<Arguments>();
  command->add_option("RUN", given->run, "directory of a run, or its run.db")->required();
  command->add_flag("--json", given->json, "one JSON object instead");
  command->add_flag("--verify", given->verify,
                    "compare the whole record with its digests first, and look through the file's "
                    "pages; info, export and render compare what they read, resume and audit all");
  command->callback([given] {
    const RunReader run(given->run);
    if (given->verify) run.verify();
    (given->json ? print_json : print_text)(run, run.experiment());
  });
}

}  // namespace metamorph::evolve
