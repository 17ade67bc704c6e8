// Progressive search: fitness lets stage after stage of life in (eq 7).

#include "evolve/search/progressive.h"

#include <algorithm>

#include "evolve/search/neat_search.h"

namespace metamorph::evolve {

double progressive_weight(int stage, int stages, int generation, int generations) {
  if (stage == 0) return 1;
  // In parts of a generation, so that the borders are met exactly.
  const std::int64_t parts = 2 * stages - 1, length = generations;
  const std::int64_t into = parts * generation - (2 * stage - 1) * length;
  if (into < 0) return 0;
  if (into >= length) return 1;
  return static_cast<double>(into) / generations;
}

double progressive_fitness(const Evaluation& evaluation, const std::vector<int>& stage,
                           const std::vector<double>& weight) {
  double product = 1;
  for (std::size_t o = 0; o < stage.size(); ++o) {
    const double objective = evaluation.objectives[o];
    product *= stage[o] == 0 ? objective
                             : weight[static_cast<std::size_t>(stage[o])] * (objective - 1) + 1;
  }
  return root(product, static_cast<int>(stage.size())) * evaluation.factor;
}

namespace {

/// [objectives] the rank of its stage among those there are, and their number.
std::pair<std::vector<int>, int> ranked_stages(const Problem& problem) {
  std::vector<int> distinct;
  for (const Objective& objective : problem.objectives) distinct.push_back(objective.stage);
  std::sort(distinct.begin(), distinct.end());
  distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
  std::vector<int> rank;
  for (const Objective& objective : problem.objectives) {
    rank.push_back(static_cast<int>(
        std::lower_bound(distinct.begin(), distinct.end(), objective.stage) - distinct.begin()));
  }
  return {rank, static_cast<int>(distinct.size())};
}

class Progressive : public Scorer {
 public:
  explicit Progressive(const Problem& problem) : generations_(problem.generations) {
    std::tie(stage_, stages_) = ranked_stages(problem);
  }

  std::vector<double> score(const PopulationState& population,
                            std::span<const Evaluation> evaluations) override {
    const std::vector<double> weight = weights(population.generation);
    std::vector<double> scores;
    for (const Evaluation& evaluation : evaluations) {
      scores.push_back(progressive_fitness(evaluation, stage_, weight));
    }
    return scores;
  }

  std::vector<std::uint8_t> measured(int generation) const override {
    std::vector<std::uint8_t> result;
    for (const int stage : stage_) {
      const std::int64_t parts = 2 * stages_ - 1;
      const bool begun = parts * generation >= (2 * stage - 1) * std::int64_t{generations_};
      result.push_back(begun ? 1 : 0);
    }
    return result;
  }

  bool restarts_records(int generation) const override {
    return generation > 0 && weights(generation) != weights(generation - 1);
  }

  bool is_paced() const override { return true; }

 private:
  std::vector<double> weights(int generation) const {
    std::vector<double> weight;
    for (int s = 0; s < stages_; ++s) {
      weight.push_back(progressive_weight(s, stages_, generation, generations_));
    }
    return weight;
  }

  int generations_;
  std::vector<int> stage_;  ///< [objectives] 0: from the start
  int stages_ = 0;
};

std::unique_ptr<Search> make(const SearchSetup& setup) {
  return std::make_unique<NeatSearch>(setup, std::make_unique<Progressive>(setup.problem));
}

std::vector<Contradiction> contradictions(const SearchSetup& setup) {
  const std::vector<Objective>& objectives = setup.problem.objectives;
  if (objectives.size() < 2) {
    return {{"search.kind",
             "simple or novelty: progressive search needs trials of two stages at "
             "least (larva, adult), there is " +
                 std::to_string(objectives.size()) + " trial"}};
  }
  for (std::size_t o = 1; o < objectives.size(); ++o) {
    if (objectives[o].stage < objectives[o - 1].stage) {
      return {{"trials." + objectives[o - 1].name + ".stage",
               "at most trials." + objectives[o].name +
                   ".stage = " + std::to_string(objectives[o].stage) +
                   ": progressive search starts with the earlier stage"}};
    }
  }
  if (objectives.front().stage == objectives.back().stage) {
    return {{"trials." + objectives.front().name + ".stage",
             "below trials." + objectives.back().name +
                 ".stage = " + std::to_string(objectives.back().stage) +
                 ": progressive search needs two stages at least"}};
  }
  return {};
}

}  // namespace

SearchKind progressive_search() {
  return {"progressive", "first the larva, then stage after stage (eq 7)", {}, make, contradictions,
          neat_notes};
}

}  // namespace metamorph::evolve
