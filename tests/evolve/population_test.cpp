#include "evolve/genetics/population.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>

#include "evolve/genetics/distance.h"
#include "evolve/genetics/reproduction.h"
#include "evolve/genetics/species.h"
#include "metamorph/random.h"
#include "tests/evolve/fitness_rules.h"
#include "tests/evolve/random_genomes.h"

namespace metamorph::evolve {
namespace {

using testing::each;
using ::testing::IsEmpty;
using testing::pattern_fitness;
using testing::restless;

using FitnessRule = std::function<std::vector<double>(const PopulationState&)>;

std::map<std::string, FitnessRule> regimes() {
  return {
      {"all zero", [](const PopulationState& s) { return each(s, [](std::size_t) { return 0; }); }},
      {"all equal",
       [](const PopulationState& s) { return each(s, [](std::size_t) { return 7.5; }); }},
      {"one huge",
       [](const PopulationState& s) {
         return each(s, [&](std::size_t i) { return i == s.genomes.size() / 2 ? 1e300 : 0; });
       }},
      {"all huge",
       [](const PopulationState& s) {
         return each(s, [](std::size_t) { return std::numeric_limits<double>::max(); });
       }},
      {"random",
       [](const PopulationState& s) {
         evolve::RandomStream stream(evolve::Purpose::test, 1,
                                     static_cast<std::uint32_t>(s.generation), 0);
         return each(s, [&](std::size_t) { return stream.uniform(); });
       }},
      {"falling",
       [](const PopulationState& s) {
         return each(s, [&](std::size_t) { return 1.0 / (1 + s.generation); });
       }},
      {"improvable", pattern_fitness},
  };
}

void expect_sound(const PopulationState& state, const NeatSettings& settings) {
  ASSERT_EQ(static_cast<int>(state.genomes.size()), settings.population);
  ASSERT_EQ(state.individuals.size(), state.genomes.size());
  ASSERT_FALSE(state.species.empty());
  std::map<int, int> members;
  std::set<std::int64_t> ids;
  for (std::size_t i = 0; i < state.genomes.size(); ++i) {
    const Genome& genome = state.genomes[i];
    ASSERT_THAT(check(genome), IsEmpty());
    ASSERT_LT(genome.nodes.back().id, state.next_node);
    if (!genome.links.empty()) {
      ASSERT_LT(genome.links.back().innovation, state.next_innovation);
    }
    for (const LinkGene& link : genome.links) {
      ASSERT_LE(std::abs(link.weight), settings.weight_limit);
    }
    const Individual& individual = state.individuals[i];
    ids.insert(individual.id);
    ++members[individual.species];
    ASSERT_LT(individual.id, state.next_individual);
  }
  ASSERT_EQ(ids.size(), state.genomes.size());
  ASSERT_EQ(members.size(), state.species.size());
  int last = -1;
  for (const Species& species : state.species) {
    ASSERT_GT(species.id, last);
    last = species.id;
    ASSERT_EQ(species.size, members[species.id]);
    ASSERT_THAT(check(species.representative), IsEmpty());
  }
  ASSERT_LT(last, state.next_species);
}

class PopulationUnder : public ::testing::TestWithParam<std::pair<const std::string, FitnessRule>> {
};

TEST_P(PopulationUnder, StaysWholeForManyGenerations) {
  for (const bool wild : {false, true}) {
    NeatSettings settings = wild ? restless() : NeatSettings{};
    settings.population = 60;
    settings.stagnation = 10;  // so that stagnation comes within the test
    PopulationState state = first_generation(settings, 3);
    // What an innovation number joins, and what a node was put between, over the whole run.
    std::map<int, std::pair<int, int>> joined;
    for (int g = 0; g < 60; ++g) {
      expect_sound(state, settings);
      if (HasFatalFailure()) return;
      for (const Genome& genome : state.genomes) {
        for (const LinkGene& link : genome.links) {
          const auto [known, is_new] = joined.try_emplace(link.innovation, link.from, link.to);
          ASSERT_EQ(known->second, std::pair(link.from, link.to));
        }
      }
      const PopulationState before = state;
      const std::vector<double> fitness = GetParam().second(state);
      next_generation(state, settings, fitness, false, 1);

      // The same new link is new only once.
      std::map<std::pair<int, int>, int> numbers;
      for (const Genome& genome : state.genomes) {
        for (const LinkGene& link : genome.links) {
          if (link.innovation < before.next_innovation) continue;
          const auto [known, is_new] =
              numbers.try_emplace(std::pair(link.from, link.to), link.innovation);
          ASSERT_EQ(known->second, link.innovation);
        }
      }
      // Parents are of the generation before.
      for (const Individual& child : state.individuals) {
        ASSERT_GE(child.parent_a, before.individuals.front().id);
        ASSERT_LT(child.parent_a, before.next_individual);
        ASSERT_LT(child.parent_b, before.next_individual);
      }
      // The champion of every species that goes on stands unchanged in the new generation, the
      // fittest of all among them; no child but these copies is there twice.
      PopulationState recorded = before;
      const auto ranked = ranked_members(before, fitness);
      record_best(recorded.species, ranked, fitness, false);
      const auto plans = plan_reproduction(recorded, settings, fitness, ranked);
      std::size_t child = 0;
      bool best_lives = false;
      const double best = *std::max_element(fitness.begin(), fitness.end());
      for (std::size_t s = 0; s < plans.size(); ++s) {
        if (plans[s].offspring == 0) continue;
        const std::size_t champion = static_cast<std::size_t>(ranked[s].front());
        ASSERT_EQ(state.genomes[child], before.genomes[champion]);
        ASSERT_EQ(state.individuals[child].parent_a, before.individuals[champion].id);
        ASSERT_EQ(state.individuals[child].parent_b, -1);
        best_lives |= fitness[champion] == best;
        child += static_cast<std::size_t>(plans[s].offspring);
      }
      ASSERT_TRUE(best_lives);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Regimes, PopulationUnder, ::testing::ValuesIn(regimes()),
                         [](const auto& regime) {
                           std::string name = regime.param.first;
                           std::erase(name, ' ');
                           return name;
                         });

TEST(Population, NoTwoChildrenAreIdentical) {
  NeatSettings settings;
  PopulationState state = first_generation(settings, 8);
  for (int g = 0; g < 30; ++g) {
    next_generation(state, settings, pattern_fitness(state), false, 1);
    for (std::size_t i = 0; i < state.genomes.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) ASSERT_FALSE(state.genomes[i] == state.genomes[j]);
    }
  }
}

TEST(Population, ClonesAreKeptWhereNothingElseCanBeBred) {
  // No mutation at all: every child is a clone, and breeding must still end with the right number.
  NeatSettings settings;
  settings.population = 20;
  settings.mutate_weights = settings.add_link = settings.add_node = settings.remove_link = 0;
  settings.crossover = 0;
  PopulationState state = first_generation(settings, 1);
  for (int g = 0; g < 5; ++g) {
    next_generation(state, settings, pattern_fitness(state), false, 1);
    expect_sound(state, settings);
  }
}

TEST(Population, TinyPopulationsLiveOn) {
  for (const int size : {1, 2, 3, 7}) {
    NeatSettings settings;
    settings.population = size;
    settings.hidden_nodes = 1;
    PopulationState state = first_generation(settings, 5);
    for (int g = 0; g < 40; ++g) {
      next_generation(state, settings, pattern_fitness(state), false, 1);
      expect_sound(state, settings);
    }
  }
}

TEST(Population, TheBestNeverGetsWorse) {
  NeatSettings settings;
  settings.population = 100;
  PopulationState state = first_generation(settings, 11);
  double best = 0;
  double first = 0;
  for (int g = 0; g < 80; ++g) {
    const std::vector<double> fitness = pattern_fitness(state);
    const double present = *std::max_element(fitness.begin(), fitness.end());
    if (g == 0) first = present;
    ASSERT_GE(present, best);
    best = present;
    next_generation(state, settings, fitness, false, 1);
  }
  EXPECT_GT(best, first);
}

TEST(Population, SpeciesHoldWhatIsNearTheirRepresentative) {
  NeatSettings settings;
  settings.population = 100;
  PopulationState state = first_generation(settings, 4);
  bool several = false;
  for (int g = 0; g < 60; ++g) {
    next_generation(state, settings, pattern_fitness(state), false, 1);
    several |= state.species.size() > 1;
    for (std::size_t i = 0; i < state.genomes.size(); ++i) {
      for (const Species& species : state.species) {
        const bool fits =
            distance(state.genomes[i], species.representative, settings.weight_difference_factor) <
            state.compatibility_threshold;
        if (species.id == state.individuals[i].species) {
          ASSERT_TRUE(fits);
          break;
        }
        ASSERT_FALSE(fits);  // an earlier one would have taken it
      }
    }
  }
  EXPECT_TRUE(several);
}

TEST(Population, SpeciesAgeAndEnd) {
  NeatSettings settings;
  settings.population = 100;
  PopulationState state = first_generation(settings, 4);
  for (int g = 0; g < 40; ++g) {
    std::map<int, int> age;
    for (const Species& species : state.species) age[species.id] = species.age;
    const int next_species = state.next_species;
    next_generation(state, settings, pattern_fitness(state), false, 1);
    for (const Species& species : state.species) {
      if (age.contains(species.id)) {
        ASSERT_EQ(species.age, age[species.id] + 1);
      } else {
        ASSERT_GE(species.id, next_species);  // ids do not come back
        ASSERT_EQ(species.age, 0);
      }
    }
  }
}

TEST(Population, GoesOnFromACopyOfItsState) {
  NeatSettings settings;
  settings.population = 50;
  PopulationState whole = first_generation(settings, 2);
  PopulationState other = first_generation(settings, 99);
  PopulationState saved;
  for (int g = 0; g < 20; ++g) {
    if (g == 8) saved = whole;
    next_generation(whole, settings, pattern_fitness(whole), false, 1);
    next_generation(other, settings, pattern_fitness(other), false, 1);
  }
  for (int g = 8; g < 20; ++g) {
    next_generation(saved, settings, pattern_fitness(saved), false, 1);
  }
  EXPECT_EQ(saved, whole);
  EXPECT_NE(other, whole);
}

TEST(Population, RefusesAFitnessThatIsNone) {
  NeatSettings settings;
  settings.population = 3;
  PopulationState state = first_generation(settings, 1);
  const PopulationState before = state;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const std::vector<double>& bad :
       {std::vector<double>{1, 2}, std::vector<double>{1, nan, 1}, std::vector<double>{1, -1, 1},
        std::vector<double>{1, infinity, 1}}) {
    EXPECT_THROW(next_generation(state, settings, bad, false, 1), std::invalid_argument);
    EXPECT_EQ(state, before);
  }
}

TEST(Breeding, FollowsTheRates) {
  // One species and no clones to speak of: how often children have two parents.
  NeatSettings settings;
  settings.population = 4000;
  settings.hidden_nodes = 1;
  PopulationState state = first_generation(settings, 13);
  ASSERT_EQ(state.species.size(), 1u);
  next_generation(state, settings, pattern_fitness(state), false, 2);
  const int crossed =
      static_cast<int>(std::count_if(state.individuals.begin(), state.individuals.end(),
                                     [](const Individual& child) { return child.parent_b >= 0; }));
  const double n = settings.population - 1;  // but for the champion's copy
  EXPECT_NEAR(crossed, n * 0.75, 5 * std::sqrt(n * 0.75 * 0.25));
  for (const Individual& child : state.individuals) ASSERT_NE(child.parent_a, child.parent_b);
}

TEST(Breeding, CrossesSpeciesAtItsRate) {
  NeatSettings settings;
  settings.population = 2000;
  settings.hidden_nodes = 1;
  settings.compatibility_threshold = 1.3;
  settings.interspecies_crossover = 0.3;
  PopulationState state = first_generation(settings, 13);
  ASSERT_GT(state.species.size(), 1u);
  const PopulationState before = state;
  const std::vector<double> equal(state.genomes.size(), 1.0);
  const auto ranked = ranked_members(state, equal);
  const auto plans = plan_reproduction(state, settings, equal, ranked);
  next_generation(state, settings, equal, false, 2);
  int crossed = 0, foreign = 0;
  std::size_t child = 0;
  for (const SpeciesPlan& plan : plans) {
    // Only where a mate can be had at home is every crossover wanted a crossover done.
    for (int c = 0; c < plan.offspring; ++c, ++child) {
      const Individual& individual = state.individuals[child];
      if (individual.parent_b < 0 || plan.parents.size() < 2) continue;
      const auto species = [&](std::int64_t id) {
        return before.individuals[static_cast<std::size_t>(id)].species;
      };
      ++crossed;
      foreign += species(individual.parent_a) != species(individual.parent_b);
    }
  }
  ASSERT_GT(crossed, 500);
  EXPECT_NEAR(foreign, crossed * 0.3, 5 * std::sqrt(crossed * 0.3 * 0.7));
}

}  // namespace
}  // namespace metamorph::evolve
