#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <vector>

#include "metamorph/threads.h"
#include "tests/evolve/problems/double_pole.h"
#include "tests/evolve/problems/maze.h"
#include "tests/evolve/problems/solve.h"
#include "tests/evolve/problems/xor.h"

namespace metamorph::evolve {
namespace {

using testing::Attempt;
using testing::stanley_slope;

// Problems of which it is published how hard they are for NEAT, solved as a user would solve them:
// bench/KNOWN.md. Runs have seeds 1, 2, ...; what is asserted leaves room for another draw of runs
// (another mathematics library is one), so that a failure is a change of the search.

/// Stanley and Miikkulainen's threshold of species. Genomes without hidden nodes are too much alike
/// for the one that networks with them start from.
constexpr double small_genomes_threshold = 3;

SearchSetup setup_of(int inputs, int outputs, int population, std::uint64_t seed) {
  SearchSetup setup = testing::minimal_setup(inputs, outputs, population, seed);
  setup.neat.compatibility_threshold = small_genomes_threshold;
  return setup;
}

struct Tally {
  int solved = 0;
  double mean = 0;  ///< evaluations of the runs that solved it
};

/// Makes runs side by side and prints a line about them.
Tally tally(const char* problem, int runs, const char* published,
            const std::function<Attempt(std::uint64_t seed)>& run) {
  std::vector<Attempt> attempts(static_cast<std::size_t>(runs));
  const int threads = core::thread_count(0);
#pragma omp parallel for num_threads(threads) schedule(dynamic)
  for (int r = 0; r < runs; ++r)
    attempts[static_cast<std::size_t>(r)] = run(static_cast<std::uint64_t>(r) + 1);
  std::vector<int> evaluations;
  for (const Attempt& one : attempts)
    if (one.solved) evaluations.push_back(one.evaluations);
  std::sort(evaluations.begin(), evaluations.end());
  Tally result;
  result.solved = static_cast<int>(evaluations.size());
  double median = 0;
  if (!evaluations.empty()) {
    const std::size_t n = evaluations.size();
    for (const int one : evaluations) result.mean += one / static_cast<double>(n);
    median = (evaluations[(n - 1) / 2] + evaluations[n / 2]) / 2.0;
  }
  std::printf("| %s | %d of %d | %.0f | %.0f | %s |\n", problem, result.solved, runs, result.mean,
              median, published);
  std::fflush(stdout);
  return result;
}

// Measured over 300 other seeds: all solve it, in 6,700 evaluations, standard deviation 4,700. Of
// 100 runs, 98 and three standard errors above the bar of 7,000.
TEST(KnownProblems, Xor) {
  const Tally found = tally("XOR", 100, "100 of 100 in 4,755", [](std::uint64_t seed) {
    return testing::attempt(setup_of(2, 1, 150, seed), 60000,
                            [](const core::Network& network, Evaluation& evaluation) {
                              return testing::evaluate_xor(network, stanley_slope, evaluation);
                            });
  });
  EXPECT_GE(found.solved, 98);
  EXPECT_LE(found.mean, 7000 + 3 * 4700 / std::sqrt(100));
}

TEST(KnownProblems, DoublePoleWithVelocities) {
  const Tally found = tally("double pole with velocities", 50, "3,600", [](std::uint64_t seed) {
    return testing::attempt(
        setup_of(6, 1, 150, seed), 60000, [](const core::Network& network, Evaluation& evaluation) {
          return testing::evaluate_with_velocities(network, stanley_slope, evaluation);
        });
  });
  EXPECT_GE(found.solved, 49);  // one in a hundred would be lost for good
  EXPECT_LE(found.mean, 7500);
}

/// Published, for this problem; the others have 150.
constexpr int population_without_velocities = 1000;

/// The best of each generation has to hold the poles for long and from 200 of 625 starts.
Attempt hold_without_velocities(testing::PoleSenses senses, int cap, std::uint64_t seed) {
  return testing::attempt(
      setup_of(testing::input_count(senses), 1, population_without_velocities, seed), cap,
      [&](const std::vector<core::Network>& networks, std::vector<Evaluation>& told) {
        std::size_t best = 0;
        for (std::size_t i = 0; i < networks.size(); ++i) {
          testing::Controller controller(networks[i], stanley_slope);
          told[i].objectives = {testing::damped_fitness(
              testing::balance(controller, senses, testing::pole_start(), testing::short_balance))};
          if (told[i].objectives[0] > told[best].objectives[0]) best = i;
        }
        testing::Controller controller(networks[best], stanley_slope);
        return testing::balance(controller, senses, testing::pole_start(), testing::long_balance)
                       .choices == testing::long_balance &&
               testing::generalization(networks[best], stanley_slope, senses) >= 200;
      });
}

// The published figure is of recurrent networks, ours of such that see the last change.
TEST(KnownProblems, DoublePoleWithoutVelocities) {
  const Tally found = tally("double pole without velocities", 20, "33,184", [](std::uint64_t seed) {
    return hold_without_velocities(testing::PoleSenses::history, 60000, seed);
  });
  EXPECT_GE(found.solved, 18);
  EXPECT_LE(found.mean, 33184);
}

// What answers positions alone cannot damp: about upright, the force of a smooth controller depends
// on positions only, so that motions come in pairs, one the other run backwards.
TEST(KnownProblems, DoublePoleIsNotHeldByPositionsAlone) {
  const Tally found = tally("double pole, positions alone", 10, "-", [](std::uint64_t seed) {
    return hold_without_velocities(testing::PoleSenses::positions, 15000, seed);
  });
  EXPECT_EQ(found.solved, 0);
}

Attempt walk_the_maze(const char* kind, std::uint64_t seed) {
  SearchSetup setup = setup_of(10, 2, 250, seed);
  setup.settings.kind = kind;
  setup.settings.values["archive_threshold"] = 6.0;  // Lehman and Stanley's, in units of the maze
  setup.problem.descriptors = {{"x", 0, 0, 200}, {"y", 0, 0, 205}};
  return testing::attempt(setup, 50000, [](const core::Network& network, Evaluation& evaluation) {
    return testing::evaluate_maze(network, stanley_slope, evaluation);
  });
}

TEST(KnownProblems, HardMazeByNovelty) {
  const Tally found = tally("hard maze by novelty", 40, "39 of 40 in 35,109",
                            [](std::uint64_t seed) { return walk_the_maze("novelty", seed); });
  EXPECT_GE(found.solved, 36);
}

TEST(KnownProblems, HardMazeByFitness) {
  const Tally found = tally("hard maze by fitness", 40, "3 of 40",
                            [](std::uint64_t seed) { return walk_the_maze("simple", seed); });
  EXPECT_LE(found.solved, 10);
}

}  // namespace
}  // namespace metamorph::evolve
