#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <string>
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

struct Tally {
  int runs = 0, solved = 0;
  double mean = 0, median = 0;  ///< evaluations of the runs that solved it
};

/// Runs from seeds 1, 2, ... side by side, and prints what came of them.
Tally tally(const std::string& problem, int runs, const std::string& published,
            const std::function<Attempt(std::uint64_t seed)>& run) {
  std::vector<Attempt> attempts(static_cast<std::size_t>(runs));
  const int threads = core::thread_count(0);
#pragma omp parallel for num_threads(threads) schedule(dynamic)
  for (int r = 0; r < runs; ++r)
    attempts[static_cast<std::size_t>(r)] = run(static_cast<std::uint64_t>(r) + 1);
  Tally result;
  result.runs = runs;
  std::vector<double> evaluations;
  double best = 0;
  for (const Attempt& one : attempts) {
    best = std::max(best, one.best);
    if (one.solved) evaluations.push_back(one.evaluations);
  }
  std::sort(evaluations.begin(), evaluations.end());
  const std::size_t n = evaluations.size();
  result.solved = static_cast<int>(n);
  for (const double one : evaluations) result.mean += one / static_cast<double>(n);
  if (n > 0) result.median = (evaluations[(n - 1) / 2] + evaluations[n / 2]) / 2;
  std::printf("| %s | %d/%d | %.0f | %.0f | %s | best %g\n", problem.c_str(), result.solved, runs,
              result.mean, result.median, published.c_str(), best);
  return result;
}

TEST(KnownProblems, Xor) {
  for (const double slope : {stanley_slope, 1.0})
    tally("XOR", 100, "4,755 (Stanley and Miikkulainen 2002)", [&](std::uint64_t seed) {
      return testing::attempt(testing::minimal_setup(2, 1, 150, seed), 60000,
                              [&](const core::Network& network, Evaluation& evaluation) {
                                return testing::evaluate_xor(network, slope, evaluation);
                              });
    });
}

TEST(KnownProblems, DoublePoleWithVelocities) {
  for (const double slope : {stanley_slope, 1.0})
    tally("double pole with velocities", 50, "3,600", [&](std::uint64_t seed) {
      return testing::attempt(testing::minimal_setup(6, 1, 150, seed), 60000,
                              [&](const core::Network& network, Evaluation& evaluation) {
                                return testing::evaluate_with_velocities(network, slope,
                                                                         evaluation);
                              });
    });
}

TEST(KnownProblems, HardMaze) {
  for (const char* kind : {"novelty", "simple"})
    tally(std::string("hard maze, ") + kind, 40, "39/40", [&](std::uint64_t seed) {
      SearchSetup setup = testing::minimal_setup(10, 2, 250, seed);
      setup.settings.kind = kind;
      setup.settings.values["archive_threshold"] = 6.0;
      setup.problem.descriptors = {{"x", 0, 0, 200}, {"y", 0, 0, 200}};
      return testing::attempt(setup, 50000,
                              [&](const core::Network& network, Evaluation& evaluation) {
                                return testing::evaluate_maze(network, stanley_slope, evaluation);
                              });
    });
}

TEST(KnownProblems, DoublePoleWithoutVelocities) {
  for (const auto senses : {testing::PoleSenses::history, testing::PoleSenses::positions})
    tally("double pole without velocities", 8, "33,184", [&](std::uint64_t seed) {
      return testing::attempt(
          testing::minimal_setup(testing::input_count(senses), 1, 1000, seed), 100000,
          [&](const std::vector<core::Network>& networks, std::vector<Evaluation>& told) {
            std::size_t best = 0;
            for (std::size_t i = 0; i < networks.size(); ++i) {
              testing::Controller controller(networks[i], stanley_slope);
              told[i].objectives = {testing::damped_fitness(testing::balance(
                  controller, senses, testing::pole_start(), testing::short_balance))};
              if (told[i].objectives[0] > told[best].objectives[0]) best = i;
            }
            testing::Controller controller(networks[best], stanley_slope);
            return testing::balance(controller, senses, testing::pole_start(),
                                    testing::long_balance)
                           .choices == testing::long_balance &&
                   testing::generalization(networks[best], stanley_slope, senses) >= 200;
          });
    });
}

}  // namespace
}  // namespace metamorph::evolve
