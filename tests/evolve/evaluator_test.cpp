#include "metamorph/evaluator.h"

#include <gtest/gtest.h>

#include "evolve/run/run.h"
#include "tests/evolve/runs.h"

namespace metamorph::evolve {
namespace {

using tests::networks_of;
using tests::tiny_experiment;
using tests::tiny_newt;

TEST(Evaluator, WithoutDieNoCellDies) {
  Experiment e = tiny_experiment("simple", 1);
  e.neat.population = 60;
  const auto deaths = [&] {
    const auto genomes = first_generation(e.neat, 5, shape_of(e.development)).genomes;
    int died = 0;
    std::vector<core::Network> networks;
    for (const Genome& genome : genomes) {
      networks.push_back(compile(genome, shape_of(e.development)));
    }
    for (const Evaluated& one : Evaluator(rules_of(e), 1).evaluate(networks, {1, 1}, 0)) {
      died += one.died;
    }
    return died;
  };
  EXPECT_GT(deaths(), 0);
  std::erase(e.development.outputs, core::Output::die);
  EXPECT_EQ(deaths(), 0);
}

TEST(Evaluator, RememberedResultsAreThoseOfAFreshEvaluation) {
  const Experiment e = tiny_experiment("simple", 2);
  const PopulationState population = first_generation(e.neat, 5);
  Evaluator remembering(rules_of(e), 1);
  const std::vector<std::uint8_t> both = {1, 1}, larva = {1, 0};
  const auto first = remembering.evaluate(networks_of(population.genomes), both, 0);
  // Half old, half new, in another order; then other trials, for which nothing may be reused.
  PopulationState other = first_generation(e.neat, 6);
  std::vector<Genome> mixed(population.genomes.rbegin(), population.genomes.rbegin() + 6);
  mixed.insert(mixed.end(), other.genomes.begin(), other.genomes.begin() + 6);
  for (const auto& trials : {both, larva}) {
    const auto a = remembering.evaluate(networks_of(mixed), trials, 0);
    const auto b = Evaluator(rules_of(e), 1).evaluate(networks_of(mixed), trials, 0);
    for (std::size_t i = 0; i < mixed.size(); ++i) {
      EXPECT_EQ(a[i].evaluated, trials);
      EXPECT_EQ(a[i].created, b[i].created);
      for (std::size_t t = 0; t < 2; ++t) {
        EXPECT_EQ(a[i].trials[t].distance, b[i].trials[t].distance);
        EXPECT_EQ(a[i].stages[t].cells, b[i].stages[t].cells);
      }
    }
  }
}

// Genes that are the same in all stages are one network, however they are written; and what a larva
// is does not depend on the networks of later stages.
TEST(Evaluator, TakesANetworkForEveryStageOfLife) {
  const Experiment e = tiny_newt("simple", 2);
  std::vector<std::vector<core::Network>> single, equal, mixed;
  const auto networks = networks_of(first_generation(e.neat, 5).genomes);
  const auto others = networks_of(first_generation(e.neat, 6).genomes);
  for (std::size_t i = 0; i < networks.size(); ++i) {
    single.push_back({networks[i]});
    equal.push_back({networks[i], networks[i], networks[i]});
    mixed.push_back({networks[i], networks[i], others[i]});
  }
  const std::vector<std::uint8_t> all = {1, 1, 1};
  Evaluator evaluator(rules_of(e), 1);
  const auto plain = evaluator.evaluate(networks, all, 0);
  const auto a = evaluator.evaluate(single, all, 0), b = evaluator.evaluate(equal, all, 0),
             c = evaluator.evaluate(mixed, all, 0);
  int parted = 0;
  for (std::size_t i = 0; i < networks.size(); ++i) {
    const Evaluated alone = Evaluator(rules_of(e), 1).evaluate_fully(mixed[i], 0);
    for (std::size_t t = 0; t < 3; ++t) {
      EXPECT_EQ(a[i].trials[t].distance, plain[i].trials[t].distance);
      EXPECT_EQ(b[i].trials[t].distance, plain[i].trials[t].distance);
      EXPECT_EQ(alone.trials[t].distance, c[i].trials[t].distance);
      if (t < 2) {
        EXPECT_EQ(c[i].trials[t].distance, plain[i].trials[t].distance);
      }
    }
    parted += c[i].trials[2].distance != plain[i].trials[2].distance;
  }
  EXPECT_GT(parted, 0);
}

TEST(Evaluator, TooManyCellsCostFitness) {
  Experiment e = tiny_experiment("simple", 2);
  const PopulationState population = first_generation(e.neat, 5);
  e.created_limit = 10;
  const auto results =
      Evaluator(rules_of(e), 1).evaluate(networks_of(population.genomes), {1, 1}, 0);
  bool above = false, below = false;
  for (const Evaluated& one : results) {
    EXPECT_EQ(one.penalty, one.created > 10 ? 0.1 : 1.0);
    (one.created > 10 ? above : below) = true;
  }
  EXPECT_TRUE(above && below);  // both cases are met
}

}  // namespace
}  // namespace metamorph::evolve
