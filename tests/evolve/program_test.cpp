// The built program as a person meets it: killed, interrupted, without room, with wrong input.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <fstream>
#include <random>
#include <sstream>
#include <thread>

#include "evolve/files/genome_file.h"
#include "evolve/run/run_reader.h"
#include "tests/evolve/background_program.h"
#include "tests/evolve/files.h"
#include "tests/evolve/killed_runs.h"
#include "tests/evolve/runs.h"

namespace metamorph::evolve {
namespace {

using testing::HasSubstr;
using tests::contents;
using tests::Ended;
using tests::Program;
using tests::TemporaryDirectory;
using tests::tiny_experiment;

class ProgramTest : public testing::Test {
 protected:
  ProgramTest() {
    for (const std::string kind : {"simple", "novelty"}) {
      Experiment e = tiny_experiment(kind, 12);
      std::ofstream(experiment(kind)) << to_toml(e);
    }
  }

  std::string path(const std::string& name) const { return (directory_.path() / name).string(); }
  std::string experiment(const std::string& kind) const {
    return path(kind == "simple" ? "simple.toml" : "novelty.toml");
  }
  Ended run(const std::vector<std::string>& arguments, rlim_t file_limit = 0) const {
    return Program(arguments, file_limit).wait();
  }
  /// Waits until a run has recorded so many generations.
  void await(const std::string& name, int generations) const {
    for (int tries = 0; tries < 20000; ++tries) {
      try {
        if (RunReader(path(name)).generations_done() >= generations) return;
      } catch (const InputError&) {  // not there yet
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    FAIL() << "no generation " << generations;
  }

  TemporaryDirectory directory_;
};

TEST_F(ProgramTest, KilledAtAnyMomentAndResumedIsTheSame) {
  const std::string file = experiment("novelty");
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(run({"evolve", file, "--out", path("whole"), "--threads", "1"}).exit_code, 0);
  const std::chrono::duration<double> length = std::chrono::steady_clock::now() - begin;
  const auto expected = contents(path("whole"));
  std::mt19937 random(1);  // the moments; what is tested holds for all of them
  int kills = 0;
  for (int round = 0; round < 6; ++round) {
    const std::string out = path(fmt::format("killed-{}", round));
    kills += tests::run_and_kill(file, out, 4, length, random);
    EXPECT_EQ(contents(out), expected) << round;
  }
  EXPECT_GT(kills, 0);
}

TEST_F(ProgramTest, FirstInterruptFinishesTheGenerationAndSaysHowToGoOn) {
  const std::string file = experiment("simple");
  Program program({"evolve", file, "--out", path("a"), "--generations", "5000", "--threads", "1"});
  await("a", 1);
  program.signal(SIGINT);
  const Ended ended = program.wait();
  EXPECT_EQ(ended.exit_code, 0) << ended.output;
  EXPECT_THAT(ended.output, HasSubstr("go on with: metamorph evolve --resume " + path("a")));
  const int done = RunReader(path("a")).generations_done();
  EXPECT_GE(done, 1);
  EXPECT_LT(done, 5000);
  // To the end, and it is the run that never stopped.
  const std::string end = std::to_string(done + 3);
  ASSERT_EQ(run({"evolve", "--resume", path("a"), "--generations", end}).exit_code, 0);
  ASSERT_EQ(run({"evolve", file, "--out", path("b"), "--generations", end}).exit_code, 0);
  EXPECT_EQ(contents(path("a")), contents(path("b")));
}

TEST_F(ProgramTest, SecondInterruptStopsAtOnceAndLosesNothing) {
  // A first signal that comes before the first generation ends the run in good order; then the
  // second comes too late to show anything, and the next try is made.
  for (int tries = 0; tries < 50; ++tries) {
    const std::string name = fmt::format("a{}", tries);
    // The first generation would take minutes.
    Program program({"evolve", experiment("simple"), "--out", path(name), "--threads", "1", "--set",
                     "scenes.*.run_steps=1000000"});
    await(name, 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    program.signal(SIGINT);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    program.signal(SIGINT);
    const int exit_code = program.wait().exit_code;
    EXPECT_EQ(RunReader(path(name)).generations_done(), 0);
    if (exit_code == 0) continue;
    EXPECT_EQ(exit_code, 130);
    return;
  }
  FAIL() << "never met in its first generation";
}

TEST_F(ProgramTest, NoRoomGetsOneLineAndTheRunGoesOnLater) {
  const std::string file = experiment("novelty");
  const Ended full = run({"evolve", file, "--out", path("a"), "--threads", "1"}, 300 << 10);
  EXPECT_EQ(full.exit_code, 2) << full.output;
  EXPECT_THAT(full.output, HasSubstr("run.db: "));
  const int done = RunReader(path("a")).generations_done();
  EXPECT_GT(done, 0);
  EXPECT_LT(done, 12);
  ASSERT_EQ(run({"evolve", "--resume", path("a"), "--threads", "1"}).exit_code, 0);
  ASSERT_EQ(run({"evolve", file, "--out", path("b"), "--threads", "1"}).exit_code, 0);
  EXPECT_EQ(contents(path("a")), contents(path("b")));
}

TEST_F(ProgramTest, WrongInputGetsALineAndLeavesNothing) {
  const std::string file = experiment("simple");
  const std::vector<std::pair<std::vector<std::string>, std::string>> table = {
      {{"evolve"}, "expected an experiment file, or --resume DIR"},
      {{"evolve", path("none.toml")}, "none.toml: no such file"},
      {{"evolve", file, "--out", path("x"), "--seed", "-1"}, "--seed: seed = -1: expected a whole"},
      {{"evolve", file, "--out", path("x"), "--population", "many"},
       "--population: neat.population = \"many\": expected a whole"},
      {{"evolve", file, "--out", path("x"), "--set", "neat.severe=7"},
       "--set: neat.severe = 7: expected a number from 0 to 1"},
      {{"evolve", "--set", "what", file, "--out", path("x")}, "expected key=value"},
      {{"evolve", "--set", "neat.severe=7", "--set", "seed=-1", file, "--out", path("x")},
       "--set: seed = -1: expected a whole"},
      {{"evolve", file, "--out", path("x"), "--threads", "0"}, "--threads"},
      {{"evolve", "--resume", path("x")}, "holds no run.db"},
      {{"evolve", file, "--resume", path("x"), "--seed", "3"},
       "--seed: not together with --resume"},
      {{"info", path("x")}, "no such file"},
      {{"export", path("x")}, "expected one of --champion, --table"},
  };
  for (const auto& [arguments, line] : table) {
    const Ended ended = run(arguments);
    EXPECT_EQ(ended.exit_code, 2) << line;
    EXPECT_THAT(ended.output, HasSubstr(line));
    EXPECT_FALSE(std::filesystem::exists(path("x")));
  }
}

TEST_F(ProgramTest, DevelopmentsThatBecomeNoNumbersAreCountedAsSuch) {
  // Steps far beyond what cells on such springs bear.
  std::ofstream(path("stiff.toml"))
      << "name = \"stiff\"\ngenerations = 1\n[neat]\npopulation = 100\n"
         "[development]\nstiffness = 1e6\nstep = 10\n"
         "[[trials]]\nname = \"larva\"\nstage = 600\nscene = \"water\"\n"
         "[scenes.water]\nrun_steps = 10\n";
  const Ended ended = run({"evolve", path("stiff.toml"), "--out", path("stiff")});
  EXPECT_EQ(ended.exit_code, 0) << ended.output;
  EXPECT_THAT(ended.output, HasSubstr(", bad_development "));
  const auto counts = RunReader(path("stiff")).status_counts();
  ASSERT_TRUE(counts.contains("bad_development"));
  const std::string counted = "bad_development " + std::to_string(counts.at("bad_development"));
  EXPECT_THAT(ended.output, HasSubstr(counted));
  EXPECT_THAT(run({"info", path("stiff")}).output, HasSubstr(counted));
  EXPECT_THAT(ended.output, HasSubstr(std::to_string(counts.at("bad_development")) + " failed"));
}

TEST_F(ProgramTest, ASmallPopulationIsToldOfItsSpecies) {
  const Ended small = run({"evolve", experiment("simple"), "--out", path("small"), "--generations",
                           "1", "--population", "12"});
  EXPECT_EQ(small.exit_code, 0);
  EXPECT_THAT(small.output, HasSubstr("note: neat.population = 12 has room for 2 species"));
  const Ended large = run({"evolve", experiment("simple"), "--out", path("large"), "--generations",
                           "1", "--population", "75"});
  EXPECT_THAT(large.output, ::testing::Not(HasSubstr("note:")));
}

TEST_F(ProgramTest, InfoAndExportTellWhatWasRecorded) {
  ASSERT_EQ(run({"evolve", experiment("simple"), "--out", path("a"), "--seed", "5", "--generations",
                 "3", "--threads", "1"})
                .exit_code,
            0);
  const Ended info = run({"info", path("a"), "--json"});
  EXPECT_EQ(info.exit_code, 0);
  const auto json = nlohmann::json::parse(info.output);
  const RunReader reader(path("a"));
  EXPECT_EQ(json.at("seed"), 5);
  EXPECT_EQ(json.at("generations"), 3);
  EXPECT_EQ(json.at("best").at("eq6"), reader.best().eq6);
  EXPECT_EQ(json.at("best").at("trials").at(1).at("distance"), reader.best().distances[1]);
  EXPECT_THAT(run({"info", path("a")}).output, HasSubstr("generations  3 of 3"));

  // The health of the search, from its tables: every child has an origin, whoever was founded lives
  // or has ended.
  std::int64_t children = 0;
  for (const auto& [origin, count] : json.at("origins").items()) {
    children += count.at("children").get<std::int64_t>();
    EXPECT_LE(count.at("better").get<int>() + count.at("dead").get<int>(), count.at("children"));
  }
  EXPECT_EQ(children, 3 * json.at("population").get<std::int64_t>());
  std::int64_t ended = 0;
  if (json.at("species").contains("ended")) {
    for (const auto& [why, count] : json.at("species").at("ended").items()) {
      ended += count.get<std::int64_t>();
    }
  }
  EXPECT_GE(json.at("species").at("founded").get<std::int64_t>() - ended, 1);
  EXPECT_FALSE(json.contains("archive"));
  EXPECT_THAT(run({"info", path("a")}).output, HasSubstr("children     of the last 10"));

  ASSERT_EQ(
      run({"evolve", experiment("novelty"), "--out", path("n"), "--generations", "2"}).exit_code,
      0);
  const auto novel = nlohmann::json::parse(run({"info", path("n"), "--json"}).output);
  EXPECT_GE(novel.at("archive").at("size"), 0);
  double shares = 0;
  for (const auto& [trial, share] : novel.at("behaviour_shares").items()) {
    shares += share.get<double>();
  }
  EXPECT_NEAR(shares, 1, 1e-12);
  EXPECT_THAT(run({"info", path("n")}).output, HasSubstr("behaviour    variance larva "));

  const Ended exported = run({"export", path("a"), "--champion", "2", "--out", path("g.json")});
  EXPECT_EQ(exported.exit_code, 0) << exported.output;
  EXPECT_EQ(read_genome(path("g.json")), reader.champion(2).genome);
  EXPECT_EQ(run({"export", path("a"), "--champion", "2", "--out", path("g.json")}).exit_code, 2);
  EXPECT_EQ(run({"export", path("a"), "--champion", "3"}).exit_code, 2);
  EXPECT_EQ(run({"export", path("a"), "--champion", "two"}).exit_code, 2);
  EXPECT_EQ(run({"export", path("a"), "--table", "individuals"}).output.substr(0, 20),
            "generation,position,");
  const Ended configuration = run({"export", path("a"), "--configuration"});
  EXPECT_EQ(configuration.output, to_toml(reader.experiment()));
}

}  // namespace
}  // namespace metamorph::evolve
