#include <gtest/gtest.h>

#include <vector>

#include "evolve/genetics/population.h"
#include "tests/evolve/fitness_rules.h"
#include "tests/evolve/random_genomes.h"

namespace metamorph::evolve {
namespace {

using testing::pattern_fitness;
using testing::restless;

TEST(Population, IsTheSameForAnyNumberOfThreads) {
  for (const bool wild : {false, true}) {
    NeatSettings settings = wild ? restless() : NeatSettings{};
    settings.population = 80;
    PopulationState one = first_generation(settings, 21), two = one, three = one;
    for (int g = 0; g < 25; ++g) {
      const std::vector<double> fitness = pattern_fitness(one);
      next_generation(one, settings, fitness, false, 1);
      next_generation(two, settings, fitness, false, 2);
      next_generation(three, settings, fitness, false, 3);
      ASSERT_EQ(one, two);
      ASSERT_EQ(one, three);
    }
  }
}

}  // namespace
}  // namespace metamorph::evolve
