// A search of one's own: hill climbers side by side, who learn to swim.

#include <metamorph/evaluator.h>
#include <metamorph/random.h>
#include <metamorph/search.h>
#include <metamorph/variation.h>

#include <algorithm>
#include <cstdio>

using namespace metamorph::evolve;
namespace core = metamorph::core;

/// Each climber keeps the best genome it has met and asks for a mutant of it.
class Climbers : public Search {
 public:
  Climbers(std::uint32_t count, std::uint64_t seed) : seed_(seed), scores_(count, -1) {
    for (std::uint32_t i = 0; i < count; ++i) {
      RandomStream random(Purpose::initial_genome, seed, 0, i);
      tried_.push_back(seed_genome(settings_, random));
    }
    best_ = tried_;
    next_innovation_ = static_cast<int>(best_.front().links.size());
  }

  Asked ask() const override { return {generation_, tried_, {}, {1}}; }

  Told tell(std::span<const Evaluation> evaluations) override {
    Told told;
    Innovations innovations(next_innovation_, next_node_);
    for (std::uint32_t i = 0; i < tried_.size(); ++i) {
      told.scores.push_back(geometric_mean(evaluations[i]));
      if (told.scores[i] > scores_[i]) {
        scores_[i] = told.scores[i];
        best_[i] = tried_[i];
      }
      tried_[i] = best_[i];
      RandomStream random(Purpose::mutation, seed_, static_cast<std::uint32_t>(generation_), i);
      StructuralChange change;
      mutate(tried_[i], change, settings_, random);
      innovations.apply(change, settings_, tried_[i]);
    }
    ++generation_;
    return told;
  }

  int generation() const override { return generation_; }
  double best() const { return *std::max_element(scores_.begin(), scores_.end()); }

 private:
  NeatSettings settings_;
  std::uint64_t seed_;
  int generation_ = 0, next_innovation_, next_node_ = first_hidden + settings_.hidden_nodes;
  std::vector<Genome> best_, tried_;  ///< [climbers]
  std::vector<double> scores_;        ///< [climbers] of the best
};

int main() {
  EvaluationRules rules;
  rules.development.steps = 600;
  rules.scenes = {core::water_scene()};
  rules.trials = {{"swimmer", 600, "water"}};
  Evaluator evaluator(rules);
  for (Climbers search(24, 1); search.generation() < 10;) {
    const Asked asked = search.ask();
    std::vector<core::Network> networks;
    for (const Genome& genome : asked.genomes) networks.push_back(compile(genome));
    std::vector<Evaluation> evaluations;
    for (const Evaluated& one : evaluator.evaluate(networks, asked.measured, asked.generation)) {
      evaluations.push_back(evaluation_of(one));
    }
    search.tell(evaluations);
    std::printf("generation %2d: %.9g d\n", search.generation(), search.best());
  }
}
