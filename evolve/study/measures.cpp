#include "evolve/study/measures.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "evolve/files/input_error.h"

namespace metamorph::evolve {
namespace {

/// [trials][generations] How many individuals were evaluated; 0: none.
using EvaluatedCounts = std::vector<std::vector<int>>;

EvaluatedCounts evaluated_in(const Source& source) {
  const auto generations = static_cast<std::size_t>(source.generations);
  EvaluatedCounts evaluated(source.experiment.trials.size(), std::vector<int>(generations));
  source.run.read("generation_trials", "generation, trial, evaluated", [&](const TableRow& row) {
    const auto g = static_cast<std::size_t>(row.integer(0));
    const auto trial = static_cast<std::size_t>(row.integer(1));
    if (g < generations && trial < evaluated.size()) evaluated[trial][g] = row.integer(2);
  });
  return evaluated;
}

/// True where all individuals were evaluated in that trial: else there is no telling of the best or
/// the mean of all of them (progressive search spares trials).
bool is_complete(const EvaluatedCounts& evaluated, std::size_t trial, std::size_t g) {
  return std::all_of(evaluated.begin(), evaluated.end(), [&](const std::vector<int>& other) {
    return other[g] <= evaluated[trial][g];
  });
}

}  // namespace

std::vector<bool> fully_evaluated(const Source& source) {
  const EvaluatedCounts evaluated = evaluated_in(source);
  std::vector<bool> fully(static_cast<std::size_t>(source.generations), true);
  for (std::size_t g = 0; g < fully.size(); ++g) {
    for (std::size_t t = 0; t < evaluated.size(); ++t) {
      fully[g] = fully[g] && is_complete(evaluated, t, g);
    }
  }
  return fully;
}

std::string titled(std::string name) {
  if (!name.empty() && name[0] >= 'a' && name[0] <= 'z') {
    name[0] = static_cast<char>(name[0] - 'a' + 'A');
  }
  return name;
}

std::vector<std::string> Source::places() const {
  std::vector<std::string> places;
  for (const Trial& trial : experiment.trials) {
    std::string place = matched_by == MatchedBy::trial ? trial.name : trial.scene;
    const auto earlier =
        std::count_if(experiment.trials.begin(), experiment.trials.begin() + std::ssize(places),
                      [&](const Trial& other) {
                        return (matched_by == MatchedBy::trial ? other.name : other.scene) == place;
                      });
    if (earlier > 0) place += fmt::format(" {}", earlier + 1);
    places.push_back(std::move(place));
  }
  return places;
}

std::vector<double> Source::unknown() const {
  return std::vector<double>(static_cast<std::size_t>(generations),
                             std::numeric_limits<double>::quiet_NaN());
}

void Source::lacks(std::string_view what, std::string_view expected) const {
  throw InputError(fmt::format("{}: {}: expected {}", run.file().string(), what, expected));
}

std::vector<Measure> read_fitness(const Source& source) {
  Measure best{"best", "", "Best of the generation", "fitness (eq 6), d", source.unknown()};
  Measure mean{"mean", "", "Mean of the population", "fitness (eq 6), d", source.unknown()};
  const std::vector<bool> fully = fully_evaluated(source);
  source.run.read("generations", "generation, best_eq6, mean_eq6", [&](const TableRow& row) {
    const auto g = static_cast<std::size_t>(row.integer(0));
    if (g >= best.values.size()) return;
    best.values[g] = row.number(1);
    if (fully[g]) mean.values[g] = row.number(2);
  });
  return {best, mean};
}

std::vector<Measure> read_distances(const Source& source) {
  struct Column {
    const char* what;
    const char* title;
  };
  constexpr Column columns[] = {
      {"champion", "the best by eq 6"}, {"best", "the farthest"}, {"mean", "mean of all"}};
  const std::vector<std::string> places = source.places();
  std::vector<Measure> measures;
  for (const Column& column : columns) {
    for (const std::string& place : places) {
      measures.push_back({column.what, place, fmt::format("{}: {}", titled(place), column.title),
                          "distance, d", source.unknown()});
    }
  }
  const EvaluatedCounts evaluated = evaluated_in(source);
  source.run.read("generation_trials",
                  "generation, trial, champion_distance, best_distance, mean_distance",
                  [&](const TableRow& row) {
                    const auto g = static_cast<std::size_t>(row.integer(0));
                    const auto trial = static_cast<std::size_t>(row.integer(1));
                    if (std::cmp_greater_equal(g, source.generations) || trial >= places.size())
                      return;
                    measures[trial].values[g] = row.number(2);
                    if (!is_complete(evaluated, trial, g)) return;
                    measures[places.size() + trial].values[g] = row.number(3);
                    measures[2 * places.size() + trial].values[g] = row.number(4);
                  });
  return measures;
}

std::vector<Measure> read_cells(const Source& source) {
  const std::vector<Trial>& trials = source.experiment.trials;
  const std::vector<std::string> places = source.places();
  // Trials of one stage have one embryo: told once, unless they are told apart by scenes.
  std::vector<Measure> measures;
  std::vector<std::size_t> measure_of(trials.size());
  for (std::size_t t = 0; t < trials.size(); ++t) {
    std::size_t same = t;
    if (source.matched_by == MatchedBy::trial) {
      const auto first = std::find_if(trials.begin(), trials.end(), [&](const Trial& other) {
        return other.stage == trials[t].stage;
      });
      same = static_cast<std::size_t>(first - trials.begin());
    }
    if (same < t) {
      measure_of[t] = measure_of[same];
      measures[measure_of[t]].title += ", " + trials[t].name;
      continue;
    }
    measure_of[t] = measures.size();
    measures.push_back(
        {"cells", places[t], titled(places[t]), "cells of the best by eq 6", source.unknown()});
  }
  source.run.read("champion_outcomes", "generation, trial, cells", [&](const TableRow& row) {
    const auto g = static_cast<std::size_t>(row.integer(0));
    const auto trial = static_cast<std::size_t>(row.integer(1));
    if (std::cmp_greater_equal(g, source.generations) || trial >= trials.size()) return;
    measures[measure_of[trial]].values[g] = row.number(2);
  });
  return measures;
}

std::vector<Measure> read_metamorphosis(const Source& source) {
  const std::vector<int> stages = source.experiment.stages();
  if (stages.size() < 2) source.lacks("one stage of life", "a run with a metamorphosis");
  std::vector<Measure> measures;
  for (std::size_t m = 0; m + 1 < stages.size(); ++m) {
    const std::string where = m == 0 ? "" : fmt::format("metamorphosis {}", m + 1);
    const std::string of = m == 0 ? "" : ", " + where;
    measures.push_back(
        {"died", where, "Cells that died" + of, "cells of the best by eq 6", source.unknown()});
    measures.push_back({"added", where, "Cells that were added" + of, "cells of the best by eq 6",
                        source.unknown()});
  }
  std::vector<int> champions(static_cast<std::size_t>(source.generations), -1);
  source.run.read("champions", "generation, position", [&](const TableRow& row) {
    const auto g = static_cast<std::size_t>(row.integer(0));
    if (g < champions.size()) champions[g] = row.integer(1);
  });
  source.run.read("metamorphosis", "generation, position, from_stage, died, born",
                  [&](const TableRow& row) {
                    const auto g = static_cast<std::size_t>(row.integer(0));
                    if (g >= champions.size() || champions[g] != row.integer(1)) return;
                    const auto from = std::find(stages.begin(), stages.end(), row.integer(2));
                    const auto m = static_cast<std::size_t>(from - stages.begin());
                    if (m + 1 >= stages.size()) return;
                    measures[2 * m].values[g] = row.number(3);
                    measures[2 * m + 1].values[g] = row.number(4);
                  });
  return measures;
}

const std::vector<PlotKind>& plot_kinds() {
  static const std::vector<PlotKind> kinds = {
      {"fitness", "Fitness", "best, mean: of the population, eq 6 (figures 10, 13, 20)",
       read_fitness},
      {"distances", "Distances",
       "champion, best, mean: of every trial, the best by eq 6, the farthest and the mean "
       "(figures 11, 12, 14, 20, 22)",
       read_distances},
      {"cells", "Cells", "cells: of the best by eq 6 at every stage (figures 15, 16)", read_cells},
      {"metamorphosis", "Metamorphosis",
       "died, added: cells from one stage to the next, of the best by eq 6 (figures 17, 18)",
       read_metamorphosis},
      {"species", "Species", "species, threshold: how many, and the genomes' distance between them",
       read_species},
      {"archive", "Archive",
       "size, threshold of a novelty archive; filled, qd_score of a map of elites", read_archive},
      {"failures", "Failures",
       "dead: with fitness 0; no_body, not_settled, failed: evaluations that ended so",
       read_failures},
      {"time", "Time", "all, develop, extract, locomotion, search, record: seconds per generation",
       read_time},
  };
  return kinds;
}

}  // namespace metamorph::evolve
