#pragma once

// Runs that are killed at random moments, and gone on with.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <filesystem>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "tests/evolve/background_program.h"

namespace metamorph::tests {

/// Runs an experiment in the directory `out`, kills it after random shares of `length`, its own
/// length, goes on with it as often as that, and lets it end. Returns how often it was killed.
inline int run_and_kill(const std::string& experiment, const std::string& out, int most_kills,
                        std::chrono::duration<double> length, std::mt19937& random) {
  std::uniform_real_distribution<> share(0, 0.5);
  int kills = 0;
  // It may have ended before, and need not begin at once.
  for (int tries = 0; tries < 2 * most_kills + 2; ++tries) {
    std::vector<std::string> arguments = {"evolve", experiment, "--out", out, "--threads", "1"};
    if (std::filesystem::exists(out)) arguments = {"evolve", "--resume", out, "--threads", "1"};
    Program program(arguments);
    if (kills < most_kills) {
      std::this_thread::sleep_for(share(random) * length);
      program.signal(SIGKILL);
    }
    const Ended ended = program.wait();
    if (ended.exit_code == 0) return kills;
    if (ended.exit_code == -1) {
      ++kills;
      continue;
    }
    // Killed within its first transaction: nothing to go on with, and nothing lost.
    EXPECT_THAT(ended.output, testing::HasSubstr(": holds no "));
    std::filesystem::remove_all(out);
  }
  ADD_FAILURE() << out << ": does not end";
  return kills;
}

}  // namespace metamorph::tests
