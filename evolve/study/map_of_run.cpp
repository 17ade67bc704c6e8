#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

#include "evolve/files/input_error.h"
#include "evolve/search/axes.h"
#include "evolve/study/field_of_run.h"
#include "metamorph/descriptors.h"

namespace metamorph::evolve {
namespace {

/// "adult: growth, cells / cells of the stage before"
std::string title_of(const Axis& axis) {
  const std::size_t dot = axis.name.rfind('.');
  const std::string_view field = std::string_view(axis.name).substr(dot + 1);
  for (const DescriptorField& known : descriptor_fields) {
    if (known.name != field) continue;
    return fmt::format("{}: {}, {}{}", axis.name.substr(0, dot), known.name, known.meaning,
                       known.unit == "1" ? "" : fmt::format(" ({})", known.unit));
  }
  return axis.name + ", d";  // a position
}

/// [niches] Where the centres of a map without a grid stand.
std::vector<Point> centres_of(const RunReader& run, int niches) {
  std::vector<Point> centres(static_cast<std::size_t>(niches));
  run.read("centroids", "niche, centre", [&](const TableRow& row) {
    const auto centre = nlohmann::json::parse(row.text(1)).get<std::vector<double>>();
    centres.at(static_cast<std::size_t>(row.integer(0))) = {centre.at(0), centre.at(1)};
  });
  return centres;
}

/// A niche of a grid, of which the second axis runs fastest.
Field::Tile tile_of(int niche, const std::vector<Axis>& axes, const std::vector<int>& bins,
                    const Colour& colour) {
  const auto edge = [&](std::size_t a, int bin) {
    return axes[a].low + (axes[a].high - axes[a].low) * bin / bins[a];
  };
  const int i = niche / bins[1], j = niche % bins[1];
  return {edge(0, i), edge(1, j), edge(0, i + 1), edge(1, j + 1), colour};
}

}  // namespace

Field map_of(const RunReader& run) {
  const RecordedMap map = run.elites();
  const Experiment experiment = run.experiment();
  const SearchSetup setup = search_setup_of(experiment, 1);
  const std::vector<Axis> axes = axes_of(setup);
  if (axes.size() != 2) {
    throw InputError(
        fmt::format("{}: search.axes: {} of them: expected two for a map that can be drawn",
                    run.file().string(), axes.size()));
  }
  double best = 0, sum = 0;
  for (const RecordedElite& elite : map.elites) {
    best = std::max(best, elite.quality);
    sum += elite.quality;
  }
  Field field;
  field.heading = fmt::format("{}, seed {}: the map", experiment.name, experiment.seed);
  field.remark = fmt::format("{} of {} niches filled after generation {}, QD score {:.5g} d",
                             map.elites.size(), map.niches, run.generations_done() - 1, sum);
  field.across = title_of(axes[0]);
  field.up = title_of(axes[1]);
  field.low = {axes[0].low, axes[1].low};
  field.high = {axes[0].high, axes[1].high};
  field.strip = {"0", "eq 6 of the elite, d", fmt::format("{:.1f}", best)};
  field.strip_colour = sequential_colour;
  const bool is_grid = setup.settings.get<int>("niches") == 0;
  const std::vector<int> bins = bins_of(setup);
  const std::vector<Point> centres = is_grid ? std::vector<Point>() : centres_of(run, map.niches);
  for (const RecordedElite& elite : map.elites) {
    const Colour colour = sequential_colour(best > 0 ? elite.quality / best : 0);
    if (is_grid) {
      field.tiles.push_back(tile_of(elite.niche, axes, bins, colour));
    } else {
      field.points.push_back({{centres.at(static_cast<std::size_t>(elite.niche))}, colour});
    }
  }
  return field;
}

}  // namespace metamorph::evolve
