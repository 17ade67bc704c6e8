#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "evolve/files/input_error.h"
#include "evolve/study/field_of_run.h"
#include "metamorph/searches.h"

namespace metamorph::evolve {
namespace {

constexpr int most_fronts = 6;
constexpr double headroom = 1.05;

/// The columns of the objectives, separated by commas.
std::string objective_columns(const SearchSetup& setup) {
  std::string columns;
  for (const Table& table : make_search(setup)->tables()) {
    if (table.name != "front") continue;
    for (const Table::Column& column : table.columns) {
      if (column.name.starts_with("objective_")) columns += fmt::format(", \"{}\"", column.name);
    }
  }
  return columns;
}

/// "larva: distance in water, d"
std::string title_of(const Trial& trial) {
  return fmt::format("{}: distance in scene {}, d", trial.name, trial.scene);
}

}  // namespace

Field front_of(const RunReader& run) {
  // Asked of the record: to make the search of a map is work.
  const std::vector<std::string> tables = run.tables();
  if (std::find(tables.begin(), tables.end(), "front") == tables.end()) {
    throw InputError(run.file().string() + ": has no table front: expected a run of nsga2");
  }
  const Experiment experiment = run.experiment();
  const std::string columns = objective_columns(search_setup_of(experiment, 1));
  if (experiment.trials.size() != 2) {
    throw InputError(fmt::format("{}: {} trials: expected two for a front that can be drawn",
                                 run.file().string(), experiment.trials.size()));
  }
  std::map<int, std::vector<Point>> fronts;
  run.read("front", "generation" + columns, [&](const TableRow& row) {
    fronts[row.integer(0)].push_back({row.number(1), row.number(2)});
  });
  if (fronts.empty()) {
    throw InputError(run.file().string() + ": holds no generation: expected one at least");
  }
  const int last = fronts.rbegin()->first;
  Field field;
  field.heading =
      fmt::format("{}, seed {}: whom nobody dominates", experiment.name, experiment.seed);
  field.across = title_of(experiment.trials[0]);
  field.up = title_of(experiment.trials[1]);
  field.strip = {"0", "generation", fmt::format("{}", last)};
  // The last one darkest: lines of light colours are hard to see on white.
  field.strip_colour = [](double t) { return sequential_colour(1 - t); };
  const int count = std::min(most_fronts, last + 1);
  std::string shown;
  for (int k = 0; k < count; ++k) {
    const int generation = count > 1 ? last * k / (count - 1) : last;
    shown += fmt::format("{}{}", k > 0 ? ", " : "", generation);
    const std::vector<Point>& points = fronts[generation];
    for (const Point& p : points) {
      field.high = {std::max(field.high.x, headroom * p.x), std::max(field.high.y, headroom * p.y)};
    }
    const double share = last > 0 ? static_cast<double>(generation) / last : 1;
    field.points.push_back({points, field.strip_colour(share), true});
  }
  field.high = {std::max(field.high.x, 1e-6), std::max(field.high.y, 1e-6)};
  field.remark = "generations " + shown;
  return field;
}

}  // namespace metamorph::evolve
