#include "evolve/genetics/reproduction.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "evolve/genetics/species.h"

namespace metamorph::evolve {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;

int sum(const std::vector<int>& parts) { return std::accumulate(parts.begin(), parts.end(), 0); }

// Shares over many orders of magnitude, zeros among them.
rc::Gen<std::vector<double>> any_shares() {
  return rc::gen::nonEmpty(rc::gen::container<std::vector<double>>(rc::gen::map(
      rc::gen::pair(rc::gen::inRange(0, 1000), rc::gen::inRange(-300, 300)),
      [](const std::pair<int, int>& p) { return p.first * std::pow(10.0, p.second); })));
}

RC_GTEST_PROP(Apportion, AddsUpExactly, ()) {
  const std::vector<double> shares = *any_shares();
  const int seats = *rc::gen::inRange(0, 1000);
  const std::vector<int> parts = apportion(shares, seats);
  RC_ASSERT(parts.size() == shares.size());
  RC_ASSERT(sum(parts) == seats);
  for (const int part : parts) RC_ASSERT(part >= 0);
}

RC_GTEST_PROP(Apportion, IsWithinOneOfTheQuotaAndMonotone, ()) {
  // Whole numbers, so that the quota's floor is known exactly.
  const std::vector<int> shares =
      *rc::gen::nonEmpty(rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 50)));
  const int seats = *rc::gen::inRange(1, 500);
  const int total = sum(shares);
  RC_PRE(total > 0);
  const std::vector<int> parts =
      apportion(std::vector<double>(shares.begin(), shares.end()), seats);
  for (std::size_t s = 0; s < shares.size(); ++s) {
    // |part - seats * share / total| < 1
    RC_ASSERT(std::abs(parts[s] * total - seats * shares[s]) < total);
    for (std::size_t t = 0; t < shares.size(); ++t) {
      if (shares[s] > shares[t]) {
        RC_ASSERT(parts[s] >= parts[t]);
      }
    }
  }
}

TEST(Apportion, LargestRemainderByHand) {
  const auto parts = [](std::vector<double> shares, int seats) { return apportion(shares, seats); };
  EXPECT_THAT(parts({47, 16, 15.8, 12, 6.1, 3.1}, 10), ElementsAre(5, 2, 1, 1, 1, 0));
  EXPECT_THAT(parts({1, 1, 1}, 4), ElementsAre(2, 1, 1));
  EXPECT_THAT(parts({0, 0}, 5), ElementsAre(3, 2));
  EXPECT_THAT(parts({0, 3, 0}, 300), ElementsAre(0, 300, 0));
  const double huge = std::numeric_limits<double>::max();
  EXPECT_THAT(parts({huge, huge, 1}, 6), ElementsAre(3, 3, 0));
}

// A state of species with the given sizes; fitness is looked up by index.
PopulationState state_of(const std::vector<int>& sizes) {
  PopulationState state;
  for (std::size_t s = 0; s < sizes.size(); ++s) {
    Species species;
    species.id = static_cast<int>(10 + s);
    species.age = 10;
    species.size = sizes[s];
    state.species.push_back(species);
    for (int i = 0; i < sizes[s]; ++i) state.individuals.push_back({0, -1, -1, species.id});
  }
  state.genomes.resize(state.individuals.size());
  return state;
}

std::vector<SpeciesPlan> plan(const PopulationState& state, const NeatSettings& settings,
                              const std::vector<double>& fitness) {
  return plan_reproduction(state, settings, fitness, ranked_members(state, fitness));
}

std::vector<int> offspring(const PopulationState& state, const NeatSettings& settings,
                           const std::vector<double>& fitness) {
  std::vector<int> numbers;
  for (const SpeciesPlan& p : plan(state, settings, fitness)) numbers.push_back(p.offspring);
  return numbers;
}

TEST(Plan, OffspringFollowSharedFitness) {
  // Mean fitness 3, 1 and 2: sizes must not matter.
  EXPECT_THAT(offspring(state_of({1, 3, 2}), {}, {3, 0.5, 1, 1.5, 2, 2}),
              ElementsAre(150, 50, 100));
}

TEST(Plan, TheFitnessFloorKeepsDeadSpeciesEqual) {
  EXPECT_THAT(offspring(state_of({1, 1, 1}), {}, {0, 0, 0}), Each(100));
  EXPECT_THAT(offspring(state_of({1, 1}), {}, {1e-4, 0}), Each(150));
}

TEST(Plan, AgeAndStagnation) {
  NeatSettings settings;
  settings.population = 210;
  settings.old_factor = 0.5;
  PopulationState state = state_of({1, 1});
  state.species[0].age = 4;  // young below 5: 1.1 to 1
  EXPECT_THAT(offspring(state, settings, {1, 1}), ElementsAre(110, 100));
  state.species[0].age = 5;
  EXPECT_THAT(offspring(state, settings, {1, 1}), ElementsAre(105, 105));
  state.species[0].age = 30;  // old above 30: 0.5 to 1
  EXPECT_THAT(offspring(state, settings, {1, 1}), ElementsAre(105, 105));
  state.species[0].age = 31;
  EXPECT_THAT(offspring(state, settings, {1, 1}), ElementsAre(70, 140));
  state.species[0].age = 10;
  state.species[0].stagnant = 49;
  EXPECT_THAT(offspring(state, settings, {1, 2}), ElementsAre(70, 140));
  state.species[0].stagnant = 50;
  EXPECT_THAT(offspring(state, settings, {1, 2}), ElementsAre(0, 210));
  // The species of the fittest is exempt, its stagnant neighbours are not.
  EXPECT_THAT(offspring(state, settings, {2, 1}), ElementsAre(140, 70));
  state.species[1].stagnant = 50;
  EXPECT_THAT(offspring(state, settings, {2, 1}), ElementsAre(210, 0));
}

TEST(Plan, TheFittestIsNeverLost) {
  // One good member among 100 dead ones: its species' mean is far below the others'.
  std::vector<int> sizes = {100};
  std::vector<double> fitness(100, 0.0);
  fitness[7] = 1;
  for (int s = 0; s < 400; ++s) {
    sizes.push_back(1);
    fitness.push_back(0.99);
  }
  const std::vector<int> numbers = offspring(state_of(sizes), {}, fitness);
  EXPECT_EQ(numbers[0], 1);
  EXPECT_EQ(sum(numbers), 300);
}

TEST(Plan, ParentsAreTheBestQuarterAndOne) {
  for (int n = 1; n <= 40; ++n) {
    std::vector<double> fitness;
    for (int i = 0; i < n; ++i) fitness.push_back((i * 17) % 41);
    const std::vector<int> parents = plan(state_of({n}), {}, fitness)[0].parents;
    ASSERT_EQ(static_cast<int>(parents.size()), n / 4 + 1);
    const double last = fitness[static_cast<std::size_t>(parents.back())];
    EXPECT_EQ(std::count_if(fitness.begin(), fitness.end(), [&](double f) { return f >= last; }),
              static_cast<std::ptrdiff_t>(parents.size()));
    EXPECT_EQ(fitness[static_cast<std::size_t>(parents.front())],
              *std::max_element(fitness.begin(), fitness.end()));
  }
}

TEST(Records, StagnationCountsGenerationsWithoutANewBest) {
  PopulationState state = state_of({2});
  const auto record = [&](std::vector<double> fitness, bool restart) {
    record_best(state.species, ranked_members(state, fitness), fitness, restart);
    return std::pair(state.species[0].best_ever, state.species[0].stagnant);
  };
  EXPECT_EQ(record({0, 0}, false), std::pair(0.0, 0));
  EXPECT_EQ(record({0, 0}, false), std::pair(0.0, 1));
  EXPECT_EQ(record({1, 2}, false), std::pair(2.0, 0));
  EXPECT_EQ(record({2, 1}, false), std::pair(2.0, 1));
  EXPECT_EQ(record({1, 0}, false), std::pair(2.0, 2));
  EXPECT_EQ(record({1, 0}, true), std::pair(1.0, 0));
}

TEST(Threshold, FollowsTheNumberOfSpecies) {
  const NeatSettings settings = paper_neat_settings();
  EXPECT_EQ(adapted_threshold(5, 4, settings), 4.8);
  EXPECT_EQ(adapted_threshold(5, 5, settings), 5);
  EXPECT_EQ(adapted_threshold(5, 30, settings), 5);
  EXPECT_EQ(adapted_threshold(5, 31, settings), 5.2);
  EXPECT_EQ(adapted_threshold(0.3, 1, settings), 0.2);
}

TEST(Threshold, SteersToANumberWhereBothAreTheSame) {
  NeatSettings settings;
  settings.species_min = settings.species_max = 12;
  EXPECT_EQ(adapted_threshold(5, 11, settings), 4.8);
  EXPECT_EQ(adapted_threshold(5, 12, settings), 5);
  EXPECT_EQ(adapted_threshold(5, 13, settings), 5.2);
}

TEST(Threshold, AsksForNoMoreSpeciesThanThePopulationHasRoomFor) {
  NeatSettings settings;
  settings.population = 20;
  settings.species_members = 5;
  EXPECT_EQ(adapted_threshold(5, 4, settings), 5);
  EXPECT_EQ(adapted_threshold(5, 5, settings), 5.2);
  EXPECT_EQ(adapted_threshold(5, 3, settings), 4.8);
  settings.population = 3;  // one at least
  EXPECT_EQ(adapted_threshold(5, 1, settings), 5);
}

}  // namespace
}  // namespace metamorph::evolve
