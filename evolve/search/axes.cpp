#include "evolve/search/axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "evolve/search/settings_check.h"

namespace metamorph::evolve {
namespace {

using Names = std::vector<std::string>;
using Numbers = std::vector<double>;

constexpr double most_niches = 1e6;

std::size_t index_of(const std::string& name, const Problem& problem) {
  const auto found = std::find_if(problem.descriptors.begin(), problem.descriptors.end(),
                                  [&](const Descriptor& d) { return d.name == name; });
  return static_cast<std::size_t>(found - problem.descriptors.begin());
}

void check_ends(const SearchSetup& setup, std::vector<Contradiction>& found) {
  const std::size_t axes = setup.settings.get<Names>("axes").size();
  for (const char* const end : {"axis_low", "axis_high"}) {
    const std::size_t given = setup.settings.get<Numbers>(end).size();
    if (given == 0 || given == axes) continue;
    found.push_back({fmt::format("search.{}", end),
                     fmt::format("a number for each of the {} axes, or none", axes)});
  }
  if (!found.empty()) return;
  const bool has_low = !setup.settings.get<Numbers>("axis_low").empty();
  for (const Axis& axis : axes_of(setup)) {
    if (axis.low < axis.high) continue;
    found.push_back({has_low ? "search.axis_low" : "search.axis_high",
                     fmt::format("low ends below high ones, {} goes from {} to {}", axis.name,
                                 axis.low, axis.high)});
  }
}

void check_bins(const SearchSetup& setup, std::vector<Contradiction>& found) {
  const Numbers& bins = setup.settings.get<Numbers>("bins");
  const std::size_t axes = setup.settings.get<Names>("axes").size();
  const bool whole =
      std::all_of(bins.begin(), bins.end(), [](double bin) { return bin == std::floor(bin); });
  if (!whole || (bins.size() != 1 && bins.size() != axes)) {
    found.push_back(
        {"search.bins", fmt::format("a whole number, or one for each of the {} axes", axes)});
    return;
  }
  double niches = 1;
  for (const int bin : bins_of(setup)) niches *= bin;
  if (niches > most_niches) {
    found.push_back(
        {"search.bins", fmt::format("at most {} niches, these are {}", most_niches, niches)});
  }
}

}  // namespace

std::vector<Setting> axis_settings() {
  return {{"axes", Names{}, 0, 0, "descriptors along which individuals are to differ"},
          {"axis_low", Numbers{}, -no_limit, no_limit,
           "low end of every axis; none: as the descriptor has it"},
          {"axis_high", Numbers{}, -no_limit, no_limit,
           "high end of every axis; none: as the descriptor has it"},
          {"bins", Numbers{20}, 1, most_niches, "niches along every axis, or one number for all"},
          {"niches", 0, 0, 1e4, "niches of a map without a grid (CVT); 0: a grid of bins"}};
}

std::vector<Contradiction> axis_faults(const SearchSetup& setup) {
  const Names& names = setup.settings.get<Names>("axes");
  std::vector<Contradiction> found = unknown_descriptors("search.axes", names, setup);
  if (names.empty()) {
    Names known;
    for (const Descriptor& d : setup.problem.descriptors) known.push_back(d.name);
    found.push_back({"search.axes", fmt::format("one at least of {}", fmt::join(known, ", "))});
  }
  Names sorted = names;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) {
    found.push_back({"search.axes", "each descriptor once"});
  }
  if (!found.empty()) return found;
  check_ends(setup, found);
  check_bins(setup, found);
  return found;
}

std::vector<Axis> axes_of(const SearchSetup& setup) {
  const Numbers& low = setup.settings.get<Numbers>("axis_low");
  const Numbers& high = setup.settings.get<Numbers>("axis_high");
  std::vector<Axis> axes;
  for (const std::string& name : setup.settings.get<Names>("axes")) {
    const std::size_t at = index_of(name, setup.problem), a = axes.size();
    const Descriptor& descriptor = setup.problem.descriptors[at];
    axes.push_back({name, at, low.empty() ? descriptor.low : low[a],
                    high.empty() ? descriptor.high : high[a]});
  }
  return axes;
}

std::vector<double> position_on(const std::vector<Axis>& axes, const Evaluation& evaluation) {
  std::vector<double> position;
  if (evaluation.descriptors.empty()) return position;
  for (const Axis& axis : axes) {
    position.push_back((evaluation.descriptors[axis.descriptor] - axis.low) /
                       (axis.high - axis.low));
  }
  return position;
}

std::vector<int> bins_of(const SearchSetup& setup) {
  const Numbers& given = setup.settings.get<Numbers>("bins");
  std::vector<int> bins;
  for (std::size_t a = 0; a < setup.settings.get<Names>("axes").size(); ++a) {
    bins.push_back(static_cast<int>(given[given.size() == 1 ? 0 : a]));
  }
  return bins;
}

}  // namespace metamorph::evolve
