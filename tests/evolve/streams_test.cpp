// The standard streams as a shell may leave them: full, closed, or a pipe that nobody reads.

#include "evolve/app/streams.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "evolve/experiment/experiment_file.h"
#include "evolve/files/body_file.h"
#include "evolve/files/genome_file.h"
#include "evolve/run/run_reader.h"
#include "tests/bodies.h"
#include "tests/evolve/child.h"
#include "tests/evolve/plain_genomes.h"
#include "tests/evolve/program.h"
#include "tests/evolve/runs.h"

namespace metamorph::evolve {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using tests::in_child;

class Streams : public ::testing::Test {
 protected:
  Streams() {
    write_genome(here() / "blob.json", tests::blob_genome(), Overwrite::no);
    write_body(here() / "disc.json", tests::disc_body(19), Overwrite::no);
    Experiment experiment = tests::tiny_experiment("simple", 2);
    experiment.neat.species_min = experiment.neat.species_max = 2;  // so few have room for no more
    write_file(here() / "tiny.toml", to_toml(experiment), Overwrite::no);
  }
  const std::filesystem::path& here() const { return directory_.path(); }
  tests::ProgramResult run(const std::string& arguments, const std::string& redirections = "",
                           const std::string& before = "true") const {
    return tests::run_program(here(), arguments, redirections, before);
  }
  void expect_no_room(const std::string& arguments) const {
    for (const char* redirection : {">/dev/full", ">&-"}) {
      const auto result = run(arguments, redirection);
      EXPECT_EQ(result.exit_code, 1) << arguments << redirection;
      EXPECT_THAT(result.err_lines(), ElementsAre(StartsWith("standard output: ")))
          << arguments << redirection;
    }
  }

 private:
  tests::TemporaryDirectory directory_;
};

const std::string small = " --set development.steps=60 --set 'trials.*.stage=60' --overwrite";

TEST_F(Streams, OutputThatIsNotWholeIsAFailure) {
  for (const char* arguments :
       {"--help", "--version", "simulate --help", "evolve --keys", "evolve tiny.toml --print",
        "simulate disc.json --steps 5", "simulate disc.json --steps 5 --json"}) {
    expect_no_room(arguments);
  }
  expect_no_room("grow blob.json --out grown --at 60 --picture none" + small);
  expect_no_room("render blob.json --out a.svg" + small);
}

TEST_F(Streams, OutputOfARunThatIsNotWholeIsAFailure) {
  ASSERT_EQ(run("evolve tiny.toml --out run --threads 1").exit_code, 0);
  for (const char* arguments : {"info run", "info run --json", "export run --list",
                                "export run --table outcomes", "export run --champion best",
                                "export run --configuration", "audit run", "audit run --json"}) {
    expect_no_room(arguments);
  }
  // What prints nothing needs no standard output.
  EXPECT_EQ(run("export run --table outcomes --out t.csv", ">&-").exit_code, 0);
  EXPECT_EQ(run("export run --table outcomes").out, tests::text_of(here() / "t.csv"));
}

TEST_F(Streams, TheExitCodeIsTrueWhereErrorsCannotBeTold) {
  for (const char* redirection : {"2>/dev/full", "2>&-"}) {
    EXPECT_EQ(run("simulate disc.json --steps 5", redirection).exit_code, 0);
    EXPECT_EQ(run("simulate none.json", redirection).exit_code, 2);
    EXPECT_EQ(run("simulate --wrong", redirection).exit_code, 2);
    EXPECT_EQ(run("info none", redirection).exit_code, 2);
    std::filesystem::remove_all(here() / "run");
    const auto evolved = run("evolve tiny.toml --out run --threads 1", redirection);
    EXPECT_EQ(evolved.exit_code, 0);
    EXPECT_THAT(evolved.out, HasSubstr("recorded in run"));
    EXPECT_EQ(RunReader(here() / "run").generations_done(), 2);
  }
  EXPECT_EQ(run("--version", ">/dev/full 2>/dev/full").exit_code, 1);
}

// Descriptors that are closed would be those of the first files that are opened, and what is
// printed would be written into these.
TEST_F(Streams, NoFileTakesTheirPlace) {
  const std::string closed = "<&- >&- 2>&-";
  EXPECT_EQ(run("evolve tiny.toml --out run --threads 1", closed).exit_code, 1);
  EXPECT_EQ(RunReader(here() / "run").generations_done(), 2);
  EXPECT_EQ(run("grow blob.json --out closed --at 60" + small, closed).exit_code, 1);
  EXPECT_EQ(run("grow blob.json --out open --at 60" + small).exit_code, 0);
  for (const char* name : {"embryo-0060.json", "development.svg"}) {
    EXPECT_EQ(tests::text_of(here() / "closed" / name), tests::text_of(here() / "open" / name));
  }
}

TEST_F(Streams, AFileSizeLimitIsAFaultOfTheFile) {
  for (const char* name : {"a.svg", "a.png", "a.pdf"}) {
    write_file(here() / name, "old", Overwrite::yes);
    // Two or four KiB, by the shell: enough for the line.
    const auto result =
        run(std::string("render disc.json --overwrite --out ") + name, "", "ulimit -f 4");
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(
        result.err_lines(),
        ElementsAre(std::string(name) + ": File too large: expected a file that can be written"));
    EXPECT_EQ(tests::text_of(here() / name), "old");
  }
  const auto moved = run("simulate disc.json --steps 50 --trajectory t.csv", "", "ulimit -f 4");
  EXPECT_EQ(moved.exit_code, 2);
  EXPECT_THAT(moved.err_lines(),
              ElementsAre("t.csv: File too large: expected a file that can be written"));
  EXPECT_EQ(moved.out, "");
  EXPECT_FALSE(std::filesystem::exists(here() / "t.csv"));
}

TEST(Tell, ThrowsNothingWhereItCannotBeHeard) {
  for (const char* file : {"/dev/full", "/dev/null"}) {
    const auto result = in_child([&]() -> std::string {
      const int other = ::open(file, std::string_view(file) == "/dev/null" ? O_RDONLY : O_WRONLY);
      ::dup2(other, STDERR_FILENO);
      tell("{} of {}\n", 1, std::string(100000, 'x'));
      return "told";
    });
    EXPECT_EQ(result.text, "told") << file;
  }
}

TEST(Tell, BrokenPipesEndTheProgramUnlessIgnored) {
  for (const bool ignored : {false, true}) {
    const auto result = in_child([&]() -> std::string {
      int ends[2];
      if (::pipe(ends) != 0) return "";
      ::close(ends[0]);
      ::dup2(ends[1], STDERR_FILENO);
      if (ignored) ignore_broken_pipes();
      tell("nobody reads this\n");
      return "told";
    });
    EXPECT_EQ(result.text, ignored ? "told" : "");
    EXPECT_EQ(WIFSIGNALED(result.status), !ignored);
  }
}

}  // namespace
}  // namespace metamorph::evolve
