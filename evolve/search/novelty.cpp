#include "evolve/search/novelty.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "evolve/search/nearest.h"

namespace metamorph::evolve {

std::vector<double> behaviour(const Evaluation& evaluation) {
  std::vector<double> positions;
  for (std::size_t t = 0; t < evaluation.trials.size(); ++t) {
    const core::Outcome& outcome = evaluation.trials[t];
    const bool moved =
        outcome.status == core::Status::ok || outcome.status == core::Status::not_settled;
    const auto [x, y] = outcome.mean_position;
    if (!moved || evaluation.evaluated[t] == 0 || !std::isfinite(x) || !std::isfinite(y)) return {};
    positions.push_back(x);
    positions.push_back(y);
  }
  return positions;
}

std::vector<double> novelty(std::span<const std::vector<double>> behaviours,
                            std::span<const ArchiveEntry> archive, int neighbours, double alone,
                            int threads) {
  std::vector<std::size_t> with_behaviour;
  for (std::size_t i = 0; i < behaviours.size(); ++i) {
    if (!behaviours[i].empty()) with_behaviour.push_back(i);
  }
  std::vector<double> scores(behaviours.size(), 0.0);
  if (with_behaviour.empty()) return scores;

  // Coordinates one after the other, the population's first: they are the queries.
  const std::size_t dimensions = behaviours[with_behaviour.front()].size();
  const std::size_t queries = with_behaviour.size();
  const std::size_t count = queries + archive.size();
  std::vector<double> points(dimensions * count);
  for (std::size_t q = 0; q < queries; ++q) {
    for (std::size_t d = 0; d < dimensions; ++d) {
      points[d * count + q] = behaviours[with_behaviour[q]][d];
    }
  }
  for (std::size_t a = 0; a < archive.size(); ++a) {
    for (std::size_t d = 0; d < dimensions; ++d) {
      points[d * count + queries + a] = archive[a].behaviour[d];
    }
  }
  std::vector<double> mean(queries);
  mean_nearest_distances(points, static_cast<int>(dimensions), neighbours, threads, mean);
  for (std::size_t q = 0; q < queries; ++q) {
    scores[with_behaviour[q]] = mean[q] < 0 ? alone : mean[q];
  }
  return scores;
}

void update_archive(const SearchSettings& settings, SearchState& state,
                    std::span<const std::vector<double>> behaviours,
                    std::span<const double> novelties, std::span<const std::int64_t> individuals,
                    int generation) {
  bool added = false;
  for (std::size_t i = 0; i < behaviours.size(); ++i) {
    if (behaviours[i].empty() || !(novelties[i] > state.archive_threshold)) {
      state.added_in_a_row = 0;
      continue;
    }
    state.archive.push_back({individuals[i], generation, novelties[i], behaviours[i]});
    added = true;
    if (++state.added_in_a_row > settings.archive_many) {
      state.archive_threshold *= settings.archive_raise;
      state.added_in_a_row = 0;
    }
  }
  state.idle_generations = added ? 0 : state.idle_generations + 1;
  if (state.idle_generations >= settings.archive_idle) {
    state.archive_threshold =
        std::max(state.archive_threshold * settings.archive_lower, settings.archive_floor);
    state.idle_generations = 0;
  }
}

}  // namespace metamorph::evolve
