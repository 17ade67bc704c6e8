// The program in less address space than it would like: whatever it cannot have, it ends in good
// order and says so.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "evolve/files/genome_file.h"
#include "tests/evolve/background_program.h"
#include "tests/evolve/plain_genomes.h"
#include "tests/evolve/program.h"
#include "tests/evolve/runs.h"

namespace metamorph::evolve {
namespace {

using testing::AnyOf;
using testing::HasSubstr;
using tests::contents;
using tests::Ended;
using tests::Program;
using tests::ProgramResult;
using tests::TemporaryDirectory;

/// The last line of what went wrong; libgomp puts an empty one before its own.
std::string last_line(const ProgramResult& ended) {
  const std::vector<std::string> lines = ended.err_lines();
  return lines.empty() ? "" : lines.back();
}

class InLittleMemory : public testing::TestWithParam<int> {
 protected:
  InLittleMemory() {
    Experiment e = tests::tiny_experiment("novelty", 8);
    e.neat.population = 100;
    std::ofstream(directory_.path() / "tiny.toml") << to_toml(e);
    write_genome(directory_.path() / "blob.json", tests::blob_genome(), Overwrite::no);
  }

  std::string threads() const { return " --threads " + std::to_string(GetParam()); }

  /// Runs the program in more and more address space, up to where nothing fails any more; calls
  /// then() after each run. Returns how many ended in a line of the program's own.
  template <class Then>
  int in_more_and_more(const std::string& arguments, const Then& then) const {
    int told = 0;
    for (int megabytes = 12; megabytes < 4000; megabytes += 1 + megabytes / 16) {
      const ProgramResult ended = tests::run_program(
          directory_.path(), arguments, "", "ulimit -v " + std::to_string(megabytes << 10));
      // 127: the loader of libraries; 1 by libgomp, too: both before and beside what the program
      // can tell.
      EXPECT_THAT(ended.exit_code, AnyOf(0, 1, 2, 127)) << megabytes << " MB: " << ended.err;
      EXPECT_THAT(ended.err, testing::Not(HasSubstr("terminate"))) << megabytes << " MB";
      if (ended.exit_code != 0) {
        EXPECT_NE(last_line(ended), "") << megabytes << " MB";
      }
      then(ended, megabytes);
      if (ended.exit_code == 0) return told;
      if (ended.exit_code == 1 || ended.exit_code == 2) {
        EXPECT_THAT(last_line(ended), AnyOf(HasSubstr("memory"), HasSubstr("libgomp: ")))
            << megabytes << " MB: " << ended.err;
        told += last_line(ended).find("memory") != std::string::npos ? 1 : 0;
      }
    }
    ADD_FAILURE() << "never enough";
    return told;
  }

  TemporaryDirectory directory_;
};

TEST_P(InLittleMemory, ARunThatWouldNotFitIsNotBegun) {
  const int told = in_more_and_more(
      "evolve tiny.toml --out part" + threads(), [&](const ProgramResult& ended, int) {
        EXPECT_EQ(std::filesystem::exists(directory_.path() / "part"), ended.exit_code == 0);
      });
  EXPECT_GT(told, 3);
}

/// Runs the program; once the directory `part` has a record, it may take no more than `more` bytes
/// beyond what it has.
Ended run_limited(const std::filesystem::path& directory, const std::string& threads,
                  std::size_t more) {
  const auto part = directory / "part";
  Program program(
      {"evolve", (directory / "tiny.toml").string(), "--out", part.string(), "--threads", threads});
  std::error_code none;
  for (int tries = 0; tries < 10000; ++tries) {
    if (std::filesystem::file_size(part / "run.db-wal", none) > 10000 && !none) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  std::size_t pages = 0;
  std::ifstream("/proc/" + std::to_string(program.process()) + "/statm") >> pages;
  const rlim_t size = pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) + more;
  const rlimit limit{size, size};
  prlimit(program.process(), RLIMIT_AS, &limit, nullptr);
  return program.wait();
}

TEST_P(InLittleMemory, ARunThatRunsOutCanBeGoneOnWith) {
  ASSERT_EQ(tests::run_program(directory_.path(), "evolve tiny.toml --out whole").exit_code, 0);
  const auto expected = contents(directory_.path() / "whole");
  const auto part = directory_.path() / "part";
  int stopped = 0;
  for (std::size_t more = 0; more <= 4 << 20; more += more / 2 + (64 << 10)) {
    const Ended ended = run_limited(directory_.path(), std::to_string(GetParam()), more);
    ASSERT_NE(ended.exit_code, -1) << more << ": " << ended.output;
    if (ended.exit_code != 0) {
      ++stopped;
      EXPECT_THAT(ended.output, AnyOf(HasSubstr("out of memory"), HasSubstr("libgomp: "))) << more;
    }
    const ProgramResult rest = tests::run_program(directory_.path(), "evolve --resume part");
    EXPECT_EQ(rest.exit_code, 0) << more << ": " << rest.err;
    EXPECT_EQ(contents(part), expected) << more;
    std::filesystem::remove_all(part);
  }
  EXPECT_GT(stopped, 2);
}

TEST_P(InLittleMemory, SimulateEndsInALine) {
  in_more_and_more("simulate blob.json --experiment tiny.toml --json" + threads(),
                   [](const ProgramResult&, int) {});
}

TEST_P(InLittleMemory, GrowEndsInALine) {
  if (GetParam() > 1) GTEST_SKIP() << "grows one embryo, on one thread";
  in_more_and_more("grow blob.json --experiment tiny.toml --out grown", [&](const auto&, int) {
    std::filesystem::remove_all(directory_.path() / "grown");
  });
}

INSTANTIATE_TEST_SUITE_P(, InLittleMemory, testing::Values(1, 2), [](const auto& threads) {
  return "Threads" + std::to_string(threads.param);
});

}  // namespace
}  // namespace metamorph::evolve
