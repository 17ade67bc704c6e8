#include "evolve/search/search.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "evolve/search/novelty.h"

namespace metamorph::evolve {

SearchState initial_state(const SearchSettings& settings) {
  SearchState state;
  state.archive_threshold = settings.archive_threshold;
  return state;
}

double scalar_fitness(const Evaluation& evaluation) {
  double product = 1;
  for (const core::Outcome& trial : evaluation.trials) product *= trial.distance;
  if (evaluation.trials.size() == 2) product = std::sqrt(product);
  return product * evaluation.penalty;
}

double progressive_weight(int generation, int generations) {
  // In thirds of a generation, so that the borders are met exactly.
  if (3 * generation < generations) return 0;
  if (3 * generation >= 2 * generations) return 1;
  return static_cast<double>(3 * generation - generations) / generations;
}

bool evaluates_trial(SearchKind kind, int trial, int generation, int generations) {
  return kind != SearchKind::progressive || trial == 0 || 3 * generation >= generations;
}

bool restarts_records(SearchKind kind, int generation, int generations) {
  return kind == SearchKind::progressive && generation > 0 &&
         progressive_weight(generation, generations) !=
             progressive_weight(generation - 1, generations);
}

namespace {

// eq 7; a single trial has nothing to progress to.
double progressive_fitness(const Evaluation& evaluation, double weight) {
  if (evaluation.trials.size() != 2) return scalar_fitness(evaluation);
  const double first = evaluation.trials[0].distance, second = evaluation.trials[1].distance;
  return std::sqrt(first * (weight * (second - 1) + 1)) * evaluation.penalty;
}

}  // namespace

std::vector<double> score_generation(const SearchSettings& settings, SearchState& state,
                                     std::span<const Evaluation> evaluations,
                                     std::span<const std::int64_t> individuals, int generation,
                                     int generations, int threads) {
  const std::size_t trials = evaluations.empty() ? 1 : evaluations.front().trials.size();
  if (individuals.size() != evaluations.size() || trials < 1 || trials > 2 ||
      std::any_of(evaluations.begin(), evaluations.end(), [&](const Evaluation& e) {
        return e.trials.size() != trials || e.evaluated.size() != trials;
      })) {
    throw std::invalid_argument(
        "score_generation: one id per evaluation and one or two trials, the same for all, "
        "expected");
  }
  std::vector<double> scores;
  scores.reserve(evaluations.size());
  if (settings.kind == SearchKind::novelty) {
    std::vector<std::vector<double>> behaviours;
    behaviours.reserve(evaluations.size());
    for (const Evaluation& evaluation : evaluations) behaviours.push_back(behaviour(evaluation));
    scores =
        novelty(behaviours, state.archive, settings.neighbours, state.archive_threshold, threads);
    update_archive(settings, state, behaviours, scores, individuals, generation);
    for (std::size_t i = 0; i < scores.size(); ++i) scores[i] *= evaluations[i].penalty;
    return scores;
  }
  const double weight = progressive_weight(generation, generations);
  for (const Evaluation& evaluation : evaluations) {
    scores.push_back(settings.kind == SearchKind::simple ? scalar_fitness(evaluation)
                                                         : progressive_fitness(evaluation, weight));
  }
  return scores;
}

}  // namespace metamorph::evolve
