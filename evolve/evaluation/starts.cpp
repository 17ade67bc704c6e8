#include "evolve/evaluation/starts.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>
#include <vector>

#include "evolve/evaluation/displaced.h"

namespace metamorph::evolve {

core::Body start_of(const core::Body& body, const Trial& trial, int start, std::uint64_t seed,
                    int generation) {
  if (!is_displaced(trial, start)) return body;
  const int drawn_in = trial.starts_renew ? generation : 0;
  return displaced(body, trial.start_displacement,
                   RandomStream(Purpose::trial_start, seed, static_cast<std::uint32_t>(drawn_in),
                                static_cast<std::uint32_t>(start)));
}

std::size_t telling_start(std::span<const core::Outcome> outcomes, StartsCombine rule) {
  assert(!outcomes.empty());
  std::vector<std::size_t> order(outcomes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const auto rank = [&](std::size_t s) {
      return std::pair(!core::is_failure(outcomes[s].status), outcomes[s].distance);
    };
    return rank(a) < rank(b);
  });
  return order[rule == StartsCombine::least ? 0 : (order.size() - 1) / 2];
}

core::Outcome combine_starts(std::span<const core::Outcome> outcomes, StartsCombine rule) {
  core::Outcome result = outcomes[telling_start(outcomes, rule)];
  if (rule != StartsCombine::mean || core::is_failure(result.status)) return result;

  result.distance = 0;
  result.mean_position = {};
  result.height = result.stance = result.gait_frequency = 0;
  int ran = 0;
  for (const core::Outcome& outcome : outcomes) {
    if (core::is_failure(outcome.status)) continue;
    ++ran;
    result.distance += outcome.distance;
    for (std::size_t c = 0; c < 2; ++c) result.mean_position[c] += outcome.mean_position[c];
    result.height += outcome.height;
    result.stance += outcome.stance;
    result.gait_frequency += outcome.gait_frequency;
  }
  result.distance /= static_cast<double>(outcomes.size());
  for (double& coordinate : result.mean_position) coordinate /= ran;
  result.height /= ran;
  result.stance /= ran;
  result.gait_frequency /= ran;
  return result;
}

}  // namespace metamorph::evolve
