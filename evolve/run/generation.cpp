#include "evolve/run/generation.h"

#include <numeric>

namespace metamorph::evolve {

double PhaseSeconds::total() const {
  const auto all = values();
  return std::accumulate(all.begin(), all.end(), 0.0);
}

PhaseSeconds& PhaseSeconds::operator+=(const PhaseSeconds& other) {
  evaluation += other.evaluation;
  search += other.search;
  record += other.record;
  return *this;
}

std::array<int, core::status_count> count_statuses(const GenerationResult& result, int trial) {
  std::array<int, core::status_count> counts{};
  for (const Evaluated& individual : result.individuals) {
    for (std::size_t t = 0; t < individual.trials.size(); ++t) {
      if (individual.evaluated[t] == 0 || (trial >= 0 && t != static_cast<std::size_t>(trial)))
        continue;
      ++counts[static_cast<std::size_t>(individual.trials[t].status)];
    }
  }
  return counts;
}

std::int64_t count_evaluations(const Experiment& experiment, const GenerationResult& result) {
  std::int64_t count = 0;
  for (std::size_t t = 0; t < experiment.trials.size(); ++t) {
    const auto counts = count_statuses(result, static_cast<int>(t));
    count += std::accumulate(counts.begin(), counts.end(), std::int64_t{0}) *
             experiment.trials[t].starts;
  }
  return count;
}

int count_near_step_limit(const GenerationResult& result) {
  int count = 0;
  for (const Evaluated& individual : result.individuals) {
    for (const core::Outcome& outcome : individual.trials) {
      count += outcome.near_step_limit ? 1 : 0;
    }
  }
  return count;
}

std::size_t best_position(const std::vector<double>& eq6, const std::vector<double>& scores) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < eq6.size(); ++i) {
    if (eq6[i] > eq6[best] || (eq6[i] == eq6[best] && scores[i] > scores[best])) best = i;
  }
  return best;
}

}  // namespace metamorph::evolve
