#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "evolve/files/input_error.h"
#include "evolve/study/field_of_run.h"
#include "metamorph/descriptors.h"

namespace metamorph::evolve {
namespace {

/// "adult: growth, cells / cells of the stage before"
std::string title_of(const MapAxis& axis) {
  const std::size_t dot = axis.name.rfind('.');
  const std::string_view field = std::string_view(axis.name).substr(dot + 1);
  for (const DescriptorField& known : descriptor_fields) {
    if (known.name != field) continue;
    return fmt::format("{}: {}, {}{}", axis.name.substr(0, dot), known.name, known.meaning,
                       known.unit == "1" ? "" : fmt::format(" ({})", known.unit));
  }
  return axis.name + ", d";  // a position
}

/// The niche of a grid around its centre.
Field::Tile tile_around(const std::vector<double>& centre, const std::vector<MapAxis>& axes,
                        const Colour& colour) {
  const auto half = [&](std::size_t a) { return (axes[a].high - axes[a].low) / axes[a].bins / 2; };
  return {centre[0] - half(0), centre[1] - half(1), centre[0] + half(0), centre[1] + half(1),
          colour};
}

}  // namespace

Field map_of(const RunReader& run) {
  const RecordedMap map = run.elites();
  const Experiment experiment = run.experiment();
  const std::vector<MapAxis>& axes = map.axes;
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
  for (const RecordedElite& elite : map.elites) {
    const Colour colour = sequential_colour(best > 0 ? elite.quality / best : 0);
    if (axes[0].bins > 0) {
      field.tiles.push_back(tile_around(elite.centre, axes, colour));
    } else {
      field.points.push_back({{{elite.centre[0], elite.centre[1]}}, colour});
    }
  }
  return field;
}

}  // namespace metamorph::evolve
