#include "tests/evolve/problems/xor.h"

#include <gtest/gtest.h>

#include "metamorph/genome.h"
#include "metamorph/variation.h"
#include "tests/evolve/problems/solve.h"
#include "tests/evolve/random_genomes.h"

namespace metamorph::evolve {
namespace {

core::Network one_node(std::vector<int> sources, std::vector<float> weights) {
  core::Network network;
  network.inputs = 3;
  network.first_link = {0, static_cast<int>(sources.size())};
  network.source = std::move(sources);
  network.weight = std::move(weights);
  network.output = {3};
  return network;
}

// A network made by hand: the output is x + y - 4 (x and y) - 1/2, steep enough to be near 0 or 1.
TEST(Xor, KnowsASolution) {
  core::Network network;
  network.inputs = 3;
  network.first_link = {0, 3, 7};
  network.source = {0, 1, 2, 0, 1, 2, 3};
  network.weight = {20, 20, -30, 20, 20, -30, -20};
  network.output = {4};
  Evaluation evaluation;
  EXPECT_TRUE(testing::evaluate_xor(network, 1, evaluation));
  EXPECT_GT(evaluation.objectives.at(0), 15);
  // Constant: every error is 1/2.
  EXPECT_FALSE(testing::evaluate_xor(one_node({}, {}), 1, evaluation));
  EXPECT_EQ(evaluation.objectives.at(0), 4);
  // Or: three of four.
  EXPECT_FALSE(testing::evaluate_xor(one_node({0, 1, 2}, {20, 20, -10}), 1, evaluation));
  EXPECT_NEAR(evaluation.objectives.at(0), 9, 0.01);
}

// No genome that the search starts from solves it, since no line parts the answers: whoever solves
// it has grown a node. The bounds of evaluations are those of
// tests/evolve/known_problems_slow_test.cpp.
TEST(Xor, IsSolvedByGrowingNodes) {
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
    const SearchSetup setup = testing::minimal_setup(2, 1, 150, seed);
    const auto solves = [](const core::Network& network, Evaluation& evaluation) {
      return testing::evaluate_xor(network, testing::stanley_slope, evaluation);
    };
    evolve::RandomStream stream = testing::test_stream(50 + static_cast<std::uint32_t>(seed));
    for (int i = 0; i < 2000; ++i) {
      Evaluation evaluation;
      EXPECT_FALSE(
          solves(compile(seed_genome(setup.neat, stream, setup.shape), setup.shape), evaluation));
    }
    EXPECT_TRUE(testing::attempt(setup, 60000, solves).solved) << "seed " << seed;
  }
}

}  // namespace
}  // namespace metamorph::evolve
