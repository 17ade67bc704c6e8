#include "evolve/run/elite_table.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "evolve/files/input_error.h"
#include "evolve/run/integrity.h"
#include "evolve/search/axes.h"
#include "evolve/search/population_json.h"

namespace metamorph::evolve {
namespace {

/// The centres of all niches, [niches][axes]. Those of a grid, of which the last axis runs fastest,
/// follow from its bins; others are in the record.
std::vector<std::vector<double>> centres_of(Database& database, const RecordedMap& map) {
  std::vector<std::vector<double>> centres(static_cast<std::size_t>(map.niches));
  if (map.axes.front().bins == 0) {
    Statement rows(database, "SELECT niche, centre FROM centroids");
    while (rows.step()) {
      centres.at(static_cast<std::size_t>(rows.integer(0))) =
          nlohmann::json::parse(rows.text(1)).get<std::vector<double>>();
    }
    return centres;
  }
  for (int niche = 0; niche < map.niches; ++niche) {
    auto& centre = centres[static_cast<std::size_t>(niche)];
    centre.resize(map.axes.size());
    int rest = niche;
    for (std::size_t a = map.axes.size(); a-- > 0;) {
      const auto& [name, low, high, bins] = map.axes[a];
      centre[a] = low + (high - low) * (rest % bins + 0.5) / bins;
      rest /= bins;
    }
  }
  return centres;
}

}  // namespace

RecordedMap read_elites(Database& database, Integrity& integrity, const Experiment& experiment) {
  const std::string file = database.file().string();
  Statement known(database, "SELECT count(*) FROM sqlite_master WHERE name = 'elites'");
  known.step();
  if (known.integer(0) == 0) {
    throw InputError(fmt::format("{}: has no table elites: expected a run of map-elites", file));
  }
  for (const char* table : {"elites", "qd", "centroids"}) integrity.check_table(table);
  RecordedMap map;
  Statement niches(database, "SELECT niches FROM qd LIMIT 1");
  if (niches.step()) map.niches = static_cast<int>(niches.integer(0));
  const SearchSetup setup = search_setup_of(experiment, 1);
  const bool is_grid = setup.settings.get<int>("niches") == 0;
  const std::vector<int> bins = bins_of(setup);
  for (const Axis& axis : axes_of(setup)) {
    map.axes.push_back({axis.name, axis.low, axis.high, is_grid ? bins[map.axes.size()] : 0});
  }
  const std::vector<std::vector<double>> centres = centres_of(database, map);
  // The last row of every niche.
  Statement last(database,
                 "SELECT niche, individual, quality, genome, max(generation) FROM elites GROUP BY "
                 "niche ORDER BY niche");
  while (last.step()) {
    RecordedElite& elite = map.elites.emplace_back();
    elite.niche = static_cast<int>(last.integer(0));
    elite.centre = centres.at(static_cast<std::size_t>(elite.niche));
    elite.individual = last.integer(1);
    elite.quality = last.real(2);
    try {
      elite.genome = genome_of(nlohmann::json::parse(last.text(3)));
    } catch (const nlohmann::json::exception& error) {
      throw InputError(fmt::format("{}: elite of niche {}: {}", file, elite.niche, error.what()));
    }
  }
  if (map.elites.empty()) {
    throw InputError(fmt::format("{}: no niche is filled yet: expected one at least", file));
  }
  return map;
}

}  // namespace metamorph::evolve
