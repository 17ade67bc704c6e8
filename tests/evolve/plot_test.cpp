// The command plot, run as a person would run it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "tests/evolve/program.h"
#include "tests/evolve/runs.h"
#include "tests/evolve/svg.h"

namespace metamorph::evolve {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using tests::run_program;
using tests::text_of;

class Plot : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    directory_ = new tests::TemporaryDirectory;
    for (const std::uint64_t seed : {1u, 2u}) {
      tests::run_whole(here() / fmt::format("run-{}", seed),
                       tests::tiny_experiment("novelty", 3, seed));
    }
    Experiment one = tests::tiny_experiment("simple", 2, 1);
    one.name = "one-trial";
    one.trials.resize(1);
    std::erase_if(one.scenes, [](const NamedScene& s) { return s.scene.name != "water"; });
    tests::run_whole(here() / "one", one);
    Record record(here() / "new", tests::tiny_experiment("simple", 2), 1);
  }
  static void TearDownTestSuite() { delete directory_; }
  static std::filesystem::path here() { return directory_->path(); }
  static tests::ProgramResult plot(const std::string& arguments) {
    return run_program(here(), "plot " + arguments);
  }

 private:
  static tests::TemporaryDirectory* directory_;
};
tests::TemporaryDirectory* Plot::directory_ = nullptr;

TEST_F(Plot, DrawsEveryKindToTheSameBytesInAnyOrder) {
  for (const std::string kind : {"fitness", "distances", "cells", "metamorphosis", "species",
                                 "archive", "failures", "time"}) {
    for (const std::string ending : {".svg", ".png", ".csv"}) {
      if (ending == ".png" && kind != "fitness") continue;  // drawn as the .svg is
      const std::string a = kind + "-a" + ending, b = kind + "-b" + ending;
      const auto first = plot("run-1 run-2 --kind " + kind + " --out " + a);
      ASSERT_EQ(first.exit_code, 0) << first.err;
      EXPECT_EQ(first.out, a + "\n");
      ASSERT_EQ(plot("run-2 run-1/run.db --kind " + kind + " --out " + b).exit_code, 0);
      EXPECT_EQ(text_of(here() / a), text_of(here() / b)) << a;
      EXPECT_GT(text_of(here() / a).size(), 100u) << a;
    }
    const tests::Svg svg = tests::read_svg(text_of(here() / (kind + "-a.svg")));
    EXPECT_EQ(svg.fault, "") << kind;
    EXPECT_GT(svg.drawn_paths, 12) << kind;  // axes, two curves and their bands
  }
  EXPECT_EQ(plot("run-1 --kind fitness --out a.pdf").exit_code, 0);
  EXPECT_THAT(text_of(here() / "a.pdf").substr(0, 5), "%PDF-");
}

TEST_F(Plot, WritesTheNumbersToo) {
  ASSERT_EQ(plot("run-1 run-2 --kind fitness --out n.svg --csv n.csv").exit_code, 0);
  ASSERT_EQ(plot("run-1 --kind fitness --curves best --out one.csv --centre median").exit_code, 0);
  std::istringstream two(text_of(here() / "n.csv")), one(text_of(here() / "one.csv"));
  std::string line;
  std::getline(two, line);
  EXPECT_EQ(line, "experiment,curve,generation,centre,low,high,runs");
  int lines = 0;
  for (; std::getline(two, line); ++lines) {
    EXPECT_THAT(line, ::testing::MatchesRegex("tiny,(best|mean),[0-2],[^,]+,[^,]+,[^,]+,2"));
  }
  EXPECT_EQ(lines, 6);
  std::getline(one, line);
  for (lines = 0; std::getline(one, line); ++lines) {  // no band of one run
    EXPECT_THAT(line, ::testing::MatchesRegex("tiny,best,[0-2],[^,]+,,,1"));
  }
  EXPECT_EQ(lines, 3);
}

TEST_F(Plot, TellsWhatWasExpectedInOneLine) {
  const auto refused = [&](const std::string& arguments, const std::string& words) {
    const auto result = plot(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_THAT(result.err_lines(), ElementsAre(HasSubstr(words))) << arguments;
  };
  refused("run-1 --kind fitness --out x.jpg",
          "--out: x.jpg: expected a name that ends in .svg, .png, .pdf or .csv");
  refused("run-1 --kind fitness --out x.svg --csv x.txt",
          "--csv: x.txt: expected a name that ends in .csv");
  refused("run-1 --kind fitness --out x.csv --csv x.csv", "expected a picture as --out");
  refused("run-1 --kind speed --out x.svg", "speed: expected fitness, distances, cells");
  refused("run-1 --kind fitness --curves worst --out x.svg",
          "--curves: worst: expected some of best, mean");
  refused("run-1 --kind fitness --centre mode --out x.svg", "mode: expected mean or median");
  refused("run-1 --out x.svg", "--kind");
  refused("run-1 --kind fitness", "--out");
  refused("none --kind fitness --out x.svg", "none");
  refused("new --kind fitness --out x.svg", "new: no generation is done yet");
  refused("one --kind metamorphosis --out x.svg",
          "one stage of life: expected a run with a metamorphosis");
  refused("one --kind archive --out x.svg", "search.kind = \"simple\"");
  refused("run-1 run-1 --kind fitness --out x.svg", "the same experiment and seed (1)");
  EXPECT_FALSE(std::filesystem::exists(here() / "x.svg"));
}

TEST_F(Plot, OverwritesNothingUnasked) {
  ASSERT_EQ(plot("run-1 --kind fitness --out o.svg --csv o.csv").exit_code, 0);
  const auto refused = plot("run-1 --kind cells --out o.svg");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err_lines(), ElementsAre(HasSubstr("o.svg: exists already")));
  // Neither is written where one may not be.
  EXPECT_EQ(plot("run-1 --kind cells --out p.svg --csv o.csv").exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(here() / "p.svg"));
  EXPECT_EQ(plot("run-1 --kind cells --out o.svg --csv o.csv --overwrite").exit_code, 0);
  EXPECT_THAT(text_of(here() / "o.csv"), HasSubstr("cells larva"));
}

}  // namespace
}  // namespace metamorph::evolve
