#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "evolve/genetics/population.h"
#include "metamorph/genome.h"
#include "metamorph/variation.h"
#include "tests/evolve/random_genomes.h"

namespace metamorph::evolve {
namespace {

// Sum of squared errors of output 0 as exclusive or of inputs 1 and 2, targets -1 and 1.
double xor_error(const Genome& genome) {
  const core::Network network = compile(genome);
  double error = 0;
  for (int question = 0; question < 4; ++question) {
    const bool x = (question & 1) != 0, y = (question & 2) != 0;
    std::vector<double> value = {0, x ? 1.0 : 0.0, y ? 1.0 : 0.0, 0, 0, 1};
    for (std::size_t n = 0; n + 1 < network.first_link.size(); ++n) {
      double sum = 0;
      for (int l = network.first_link[n]; l < network.first_link[n + 1]; ++l) {
        const std::size_t link = static_cast<std::size_t>(l);
        sum += static_cast<double>(network.weight[link]) *
               value[static_cast<std::size_t>(network.source[link])];
      }
      value.push_back(std::tanh(sum / 2));
    }
    const double answer = value[static_cast<std::size_t>(network.output[0])];
    error += std::pow(answer - (x != y ? 1 : -1), 2);
  }
  return error;
}

// An error below 1 means that all four signs are right. Selection must get there within a number
// of evaluations in which blind drawing does not even reach 2, halfway from a constant answer of 0.
TEST(Neat, SolvesXorWhereRandomSearchDoesNot) {
  const NeatSettings settings;
  const int generations = 100;
  for (const std::uint64_t seed : {1u, 2u}) {
    PopulationState state = first_generation(settings, seed);
    double best = 4;
    for (int g = 0; g < generations && best >= 1; ++g) {
      std::vector<double> fitness;
      for (const Genome& genome : state.genomes) {
        const double error = xor_error(genome);
        best = std::min(best, error);
        fitness.push_back(16 - error);
      }
      next_generation(state, settings, fitness, false, 2);
    }
    EXPECT_LT(best, 1) << "seed " << seed;
  }
  evolve::RandomStream stream = testing::test_stream(77);
  double best = 4;
  for (int i = 0; i < generations * settings.population; ++i) {
    best = std::min(best, xor_error(seed_genome(settings, stream)));
  }
  EXPECT_GT(best, 2);
}

}  // namespace
}  // namespace metamorph::evolve
