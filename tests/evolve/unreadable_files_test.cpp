// Files and names that cannot be used: one line each, and never a wait without end.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "evolve/experiment/experiment_file.h"
#include "evolve/files/body_file.h"
#include "evolve/files/genome_file.h"
#include "evolve/files/input_file.h"
#include "tests/bodies.h"
#include "tests/evolve/plain_genomes.h"
#include "tests/evolve/program.h"
#include "tests/evolve/runs.h"
#include "tests/evolve/sanitized.h"

namespace metamorph::evolve {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using tests::Json;
using tests::lines_of;

class Unreadable : public ::testing::Test {
 protected:
  const std::filesystem::path& here() const { return directory_.path(); }
  std::filesystem::path path(const std::string& name) const { return here() / name; }
  void write(const std::string& name, const std::string& text) const {
    write_file(path(name), text, Overwrite::yes);
  }
  tests::ProgramResult run(const std::string& arguments) const {
    return tests::run_program(here(), arguments);
  }
  /// The one line with which a command ends.
  std::string fault(const std::string& arguments) const {
    const auto result = run(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_EQ(result.out, "") << arguments;
    const auto lines = result.err_lines();
    EXPECT_EQ(lines.size(), 1u) << arguments;
    return lines.empty() ? "" : lines.front();
  }

 private:
  tests::TemporaryDirectory directory_;
};

TEST_F(Unreadable, WhatIsNoFile) {
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  std::filesystem::create_symlink("loop", path("loop"));
  write("large", "");
  std::filesystem::resize_file(path("large"), largest_input + 1);  // takes no room on the disk
  const std::string name(5000, 'a');
  const std::string device = ": a device, a pipe or a socket: expected a file";
  for (const std::string command : {"simulate ", "grow ", "evolve ", "render --out a.svg "}) {
    for (const char* file : {"pipe", "/dev/zero", "/dev/null"}) {
      EXPECT_EQ(fault(command + file), file + device);
    }
    EXPECT_EQ(fault(command + "large"), "large: too long: expected at most 64 MiB");
    EXPECT_THAT(fault(command + "loop"), StartsWith("loop: Too many levels of symbolic links"));
    EXPECT_THAT(fault(command + name), StartsWith(name + ": File name too long"));
  }
  for (const char* file : {"pipe", "/dev/zero"}) {
    EXPECT_EQ(fault(std::string("info ") + file),
              std::string(file) + ": not a file: expected the record of a run");
  }
  EXPECT_THAT(fault("info loop"), StartsWith("loop: Too many levels of symbolic links"));
  EXPECT_THAT(fault("info " + name), StartsWith(name + ": File name too long"));
}

// The kernel says that this file has no bytes, and gives some for every page of addresses.
TEST_F(Unreadable, AFileThatDoesNotTellItsLength) {
  const std::string file = "/proc/self/pagemap";
  if (!std::filesystem::is_regular_file(file)) GTEST_SKIP() << "no " << file;
  EXPECT_THAT(lines_of([&] { read_text(file); }),
              ElementsAre(file + ": too long: expected at most 64 MiB"));
}

TEST_F(Unreadable, NamesThatAreNoText) {
  write_body(path("b\xff.json"), tests::disc_body(19), Overwrite::no);
  write_genome(path("g\xff.json"), tests::blob_genome(), Overwrite::no);
  write("two\nlines\xff.json", "{");
  const auto moved = run("simulate 'b\xff.json' --steps 5 --json");
  EXPECT_EQ(Json::parse(moved.out)["file"], "b\\xff.json");
  EXPECT_THAT(run("simulate 'b\xff.json' --steps 5").out, HasSubstr("\nb\\xff.json "));
  EXPECT_EQ(fault("simulate 'two\nlines\xff.json'"),
            "two\\x0alines\\xff.json: line 1, column 2: the file ends: expected more JSON");
  const std::string small = " --set development.steps=60 --set 'trials.*.stage=60' ";
  const auto grown = run("grow 'g\xff.json' --picture none --json --at 60" + small);
  EXPECT_EQ(Json::parse(grown.out)["embryo_file"], "g\\xff/embryo-0060.json");
  const auto drawn = run("render 'g\xff.json' --out 'p\xff.svg'" + small);
  EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
  EXPECT_EQ(drawn.out, "p\\xff.svg\n");
  EXPECT_TRUE(std::filesystem::exists(path("p\xff.svg")));
  write("t\xff.toml", to_toml(tests::tiny_experiment("simple", 1)));
  EXPECT_EQ(run("evolve 't\xff.toml' --out 'r\xff' --threads 1").exit_code, 0);
  EXPECT_EQ(Json::parse(run("info 'r\xff' --json").out)["run"], "r\\xff/run.db");
  EXPECT_THAT(run("info 'r\xff'").out, StartsWith("r\\xff/run.db\n"));
  EXPECT_THAT(run("audit 'r\xff' --json").out, HasSubstr("r\\\\xff/run.db"));
}

TEST_F(Unreadable, ABadFileOfADirectoryDoesNotStopTheOthers) {
  std::filesystem::create_directory(path("many"));
  write_body(path("many/a.json"), tests::disc_body(7), Overwrite::no);
  write("many/b.json", "{");
  ASSERT_EQ(::mkfifo(path("many/c.json").c_str(), 0600), 0);
  write_body(path("many/d.json"), tests::disc_body(19), Overwrite::no);
  const auto result = run("simulate many --steps 5 --json");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err_lines(),
              ElementsAre("many/b.json: line 1, column 2: the file ends: expected more JSON",
                          "many/c.json: a device, a pipe or a socket: expected a file",
                          "simulate: 2 of 4 files refused, the others were simulated"));
  std::istringstream lines(result.out);
  std::vector<std::string> names;
  for (std::string line; std::getline(lines, line);) names.push_back(Json::parse(line)["file"]);
  EXPECT_THAT(names, ElementsAre("many/a.json", "many/d.json"));
  EXPECT_THAT(run("simulate many --steps 5").out,
              AllOf(HasSubstr("\nmany/a.json "), HasSubstr("\nmany/d.json ")));
  // One that was named stops all.
  const auto named = run("simulate many none.json");
  EXPECT_EQ(named.exit_code, 2);
  EXPECT_EQ(named.out, "");
  EXPECT_EQ(named.err_lines().size(), 3u);
  // And with nothing left there is nothing to do.
  std::filesystem::remove(path("many/a.json"));
  std::filesystem::remove(path("many/d.json"));
  const auto none = run("simulate many");
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_EQ(none.out, "");
  EXPECT_EQ(none.err_lines().size(), 2u);
}

TEST_F(Unreadable, SeedsAreWholeNumbersToTheLast) {
  write("tiny.toml", to_toml(tests::tiny_experiment("simple", 1)));
  const std::string largest = "9007199254740992", next = "9007199254740993";  // 2^53
  EXPECT_THAT(run("evolve tiny.toml --print --seed " + largest).out,
              HasSubstr("\nseed = " + largest + "\n"));
  const std::string expected = ": expected a whole number from 0 to " + largest;
  EXPECT_EQ(fault("evolve tiny.toml --print --seed " + next), "--seed: seed = " + next + expected);
  EXPECT_EQ(fault("evolve tiny.toml --print --seed=-1"), "--seed: seed = -1" + expected);
  std::string text = tests::text_of(path("tiny.toml"));
  const std::string seed = "seed = 3\n";
  text.replace(text.find(seed), seed.size(), "seed = " + next + "\n");
  write("tiny.toml", text);
  EXPECT_THAT(fault("evolve tiny.toml --print"), EndsWith(": seed = " + next + expected));
}

TEST_F(Unreadable, DeepNesting) {
  const auto repeated = [](const std::string& text, int times) {
    std::string result;
    for (int i = 0; i < times; ++i) result += text;
    return result;
  };
  const std::string start = "name = \"deep\"\nv = ";
  for (const std::string& text : {start + repeated("[", 100000), start + repeated("{a=", 40000),
                                  repeated("[", 100000), start + repeated("[{a=", 20000)}) {
    write("deep.toml", text);
    EXPECT_THAT(fault("evolve deep.toml --print"), HasSubstr(": not valid TOML: "));
  }
  // Tables in tables, each a call deep when they go; it is the longest that is read. A sanitizer's
  // calls take several times the stack.
  for (const auto& ends : {std::pair{"", " = 1"}, std::pair{"[", "]"}}) {
    write("deep.toml", std::string("name = \"deep\"\n") + ends.first + repeated("a.", 65000) + "a" +
                           ends.second);
    if (tests::is_sanitized) break;
    const auto result = run("evolve deep.toml --print");
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, HasSubstr("a table: unknown key"));
  }
  write("deep.toml", start + repeated("[", 300000));
  EXPECT_EQ(fault("evolve deep.toml --print"), "deep.toml: too long: expected at most 128 KiB");
  for (const char* open : {"[", "{\"a\":"}) {
    write("deep.json", repeated(open, 100000));
    EXPECT_THAT(fault("simulate deep.json"), StartsWith("deep.json: deeply nested JSON: "));
  }
}

TEST_F(Unreadable, MoreThanMemoryHolds) {
  if (tests::is_sanitized) GTEST_SKIP() << "a sanitizer needs more memory";
  std::string text = "{\"a\": [[]";
  for (int i = 0; i < 15000000; ++i) text += ",[]";
  write("many.json", text + "]}");
  const auto result = tests::run_program(here(), "simulate many.json", "", "ulimit -v 500000");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err_lines(), ElementsAre(testing::StartsWith("metamorph: out of memory")));
}

TEST_F(Unreadable, OfVeryManyFaultsTheFirstAreTold) {
  std::string text = "{\"format\": \"metamorph-body/1\", \"nodes\": [0";
  for (int i = 1; i < 500; ++i) text += ",0";
  write("wrong.json", text + "], \"triangles\": [], \"period\": [], \"phase\": []}");
  const auto lines = run("simulate wrong.json").err_lines();
  ASSERT_EQ(lines.size(), 101u);
  EXPECT_EQ(lines[99], "wrong.json: nodes[99]: 0: expected [x, y]");
  EXPECT_EQ(lines[100], "wrong.json: and 400 more");
}

}  // namespace
}  // namespace metamorph::evolve
