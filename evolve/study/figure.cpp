#include "evolve/study/figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>

namespace metamorph::evolve {
namespace {

std::string runs_text(std::size_t count) {
  return fmt::format("{} {}", count, count == 1 ? "run" : "runs");
}

/// "5 runs, mean and 95 % bootstrap bands": what holds of all experiments.
std::string remark_of(const Study& study, Centre centre) {
  const auto& experiments = study.experiments;
  const auto more_than_one = [](const StudiedExperiment& e) { return e.seeds.size() > 1; };
  std::string remark;
  if (experiments.size() == 1) {
    remark = fmt::format("{}: {}", experiments[0].label, runs_text(experiments[0].seeds.size()));
    if (experiments[0].seeds.size() == 1) {
      remark += fmt::format(", seed {}", experiments[0].seeds[0]);
    }
  }
  if (std::any_of(experiments.begin(), experiments.end(), more_than_one)) {
    remark += fmt::format("{}{} and 95 % bootstrap bands", remark.empty() ? "" : ", ",
                          centre == Centre::mean ? "mean" : "median");
  }
  return remark;
}

/// After the last colour the first comes again, dashed.
bool is_dashed(std::size_t experiment) { return experiment / curve_colours % 2 == 1; }
Colour colour_of(std::size_t experiment) { return curve_colour(static_cast<int>(experiment)); }

/// A column for each trial where measures have several, else rows as even as they get.
int columns_of(const Study& study, std::size_t panels) {
  std::set<std::string> places;
  for (const Curve& curve : study.curves) places.insert(curve.measure.where);
  if (places.size() > 1 && places.size() <= 4) return static_cast<int>(places.size());
  return panels == 4 ? 2 : static_cast<int>(std::min<std::size_t>(panels, 3));
}

}  // namespace

Chart figure_of(const Study& study, const PlotKind& kind, Centre centre) {
  Chart chart;
  chart.heading = kind.heading;
  chart.remark = remark_of(study, centre);
  chart.across = "generation";
  chart.notes = study.notes;
  if (study.experiments.size() > 1) {
    for (std::size_t e = 0; e < study.experiments.size(); ++e) {
      const auto& [label, seeds] = study.experiments[e];
      chart.keys.push_back({fmt::format("{} ({})", label, runs_text(seeds.size())), colour_of(e),
                            is_dashed(e), seeds.size() > 1});
    }
  }
  const Measure* last = nullptr;
  for (const Curve& curve : study.curves) {
    const Measure& measure = curve.measure;
    if (last == nullptr || last->what != measure.what || last->where != measure.where) {
      chart.panels.push_back({measure.title, measure.quantity, {}});
    }
    last = &measure;
    chart.panels.back().curves.push_back({measure.values, curve.low, curve.high,
                                          colour_of(curve.experiment),
                                          is_dashed(curve.experiment)});
  }
  chart.columns = columns_of(study, chart.panels.size());
  return chart;
}

}  // namespace metamorph::evolve
