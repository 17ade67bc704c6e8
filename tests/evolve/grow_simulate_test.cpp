// The commands grow and simulate, run as a person would run them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "evolve/files/animat_file.h"
#include "evolve/files/body_file.h"
#include "evolve/files/genome_file.h"
#include "evolve/files/outcome_json.h"
#include "metamorph/automatic_step.h"
#include "metamorph/locomotion.h"
#include "metamorph/stability.h"
#include "tests/bodies.h"
#include "tests/evolve/plain_genomes.h"
#include "tests/evolve/program.h"

namespace metamorph::evolve {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using tests::blob_genome;
using tests::Json;
using tests::row_genome;
using tests::run_program;

/// The founder dies in the first update.
Genome dead_genome() {
  Genome genome = row_genome();
  genome.links = {{1, 5, 8, 1.0}};
  return genome;
}

std::vector<Json> json_lines(const std::string& text) {
  std::vector<Json> result;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) result.push_back(Json::parse(line));
  return result;
}

class Program : public ::testing::Test {
 protected:
  Program() {
    write_genome(here() / "row.json", row_genome(), Overwrite::no);
    write_genome(here() / "blob.json", blob_genome(), Overwrite::no);
    write_genome(here() / "dead.json", dead_genome(), Overwrite::no);
    write_body(here() / "disc.json", tests::disc_body(19), Overwrite::no);
  }

  const std::filesystem::path& here() const { return directory_.path(); }
  tests::ProgramResult run(const std::string& arguments) const {
    return run_program(here(), arguments);
  }
  void expect_fault(const std::string& arguments, const std::string& line) const {
    const auto result = run(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_THAT(result.err_lines(), ElementsAre(line)) << arguments;
    EXPECT_EQ(result.out, "") << arguments;
  }

 private:
  tests::TemporaryDirectory directory_;
};

TEST_F(Program, SaysWhatItCanDo) {
  EXPECT_THAT(run("--version").out, StartsWith("metamorph "));
  const auto help = run("--help");
  EXPECT_EQ(help.exit_code, 0);
  for (const char* command : {"grow", "simulate"}) {
    EXPECT_THAT(help.out, HasSubstr(command));
    EXPECT_EQ(run(std::string(command) + " --help").exit_code, 0);
  }
}

TEST_F(Program, RefusesInOneLine) {
  const std::string see = " (see metamorph simulate --help)";
  expect_fault("simulate", "metamorph simulate: INPUT is required" + see);
  expect_fault("simulate disc.json --dt 0",
               "metamorph simulate: --dt: 0: expected a number from 1e-06 to 10 or auto" + see);
  expect_fault("simulate disc.json --dt Auto",
               "metamorph simulate: --dt: Auto: expected a number from 1e-06 to 10 or auto" + see);
  expect_fault("simulate disc.json --steps 1e3",
               "metamorph simulate: --steps: 1e3: expected an integer from 1 to 100000000" + see);
  expect_fault("simulate disc.json --stage 1300",
               "--stage: 1300: expected at most 1200, the end of development");
  expect_fault("simulate disc.json row.json --trajectory t.csv",
               "--trajectory: 2 bodies: expected one");
  expect_fault("grow row.json --at 10,1201",
               "--at: 1201: expected steps from 0 to 1200, the end of development");
  expect_fault("grow disc.json",
               "disc.json: format: \"metamorph-body/1\": expected \"metamorph-genome/1\"");
  expect_fault("grow nothing.json", "nothing.json: no such file: expected a file that can be read");
  const auto none = run("");
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_EQ(none.err_lines().size(), 1u);
}

TEST_F(Program, TellsTheFaultsOfAllFiles) {
  write_file(here() / "half.json", "{\"format\": ", Overwrite::no);
  write_file(here() / "other.json", "{\"format\": \"x\"}", Overwrite::no);
  const auto result = run("simulate half.json other.json none.json disc.json");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err_lines(),
              ElementsAre("half.json: line 1, column 12: the file ends: expected more JSON",
                          "other.json: format: x: expected metamorph-body/1 or metamorph-genome/1",
                          "none.json: no such file: expected a file that can be read"));
}

TEST_F(Program, GrowWritesTheStepsAskedFor) {
  const auto result = run("grow row.json --set development.steps=120 --at 120,60,0,60 --json");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const auto lines = json_lines(result.out);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0]["step"], 0);
  EXPECT_EQ(lines[0]["embryo_cells"], 1);
  EXPECT_EQ(lines[2]["step"], 120);
  EXPECT_EQ(lines[2]["status"], "no_body");  // a row has no triangle
  const Json embryo = Json::parse(tests::text_of(here() / "row" / "embryo-0060.json"));
  EXPECT_EQ(embryo["step"], 60);
  EXPECT_EQ(embryo["cells"].size(), lines[1]["embryo_cells"].get<std::size_t>());
  EXPECT_THAT(tests::text_of(here() / "row" / "development.svg"), HasSubstr("<svg"));
}

// Genes that begin with the adult leave the larva as it is, to the last digit; that the adult has
// them shows that commands know where its life begins.
TEST_F(Program, GrowsAndSimulatesGenesOfOneStage) {
  Genome genome = blob_genome();
  genome.links.push_back({7, 5, 6, 9.0, {1, Stages::end_of_life}});  // adults do not divide
  write_genome(here() / "parted.json", genome, Overwrite::no);
  const std::string rules = " --set development.steps=600 --json";
  const std::string stages = " --at 300,600";
  const auto plain = json_lines(run("grow blob.json" + stages + rules).out);
  const auto parted = json_lines(run("grow parted.json --check-links" + stages + rules).out);
  ASSERT_EQ(plain.size(), 2u);
  ASSERT_EQ(parted.size(), 2u);
  const auto file = [&](const char* name) { return tests::text_of(here() / name); };
  EXPECT_EQ(file("blob/embryo-0300.json"), file("parted/embryo-0300.json"));
  EXPECT_EQ(parted[1]["embryo_cells"], parted[0]["embryo_cells"]);
  EXPECT_GT(plain[1]["embryo_cells"], plain[0]["embryo_cells"]);
  const auto moved =
      json_lines(run("simulate parted.json --set development.steps=600 --steps 20 --json").out);
  ASSERT_EQ(moved.size(), 1u);
  EXPECT_EQ(moved[0]["cells"], parted[1]["cells"]);
}

TEST_F(Program, GrowChecksLinks) {
  // A row of n cells has n - 1 links. Neighbours are renewed at every tenth step and after births:
  // a cell in each of the 4 updates, at steps 0, 30, 60 and 90. The end is a renewal, too:
  // (0 + 3 * 1) + (1 + 3 * 2) + (2 + 3 * 3) + (3 + 3 * 4) + 4 links.
  const auto result = run("grow row.json --check-links --set development.steps=120 --at 120");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out,
              HasSubstr("\n40 links at 17 renewals: all as a full triangulation has them\n"));
  EXPECT_THAT(run("grow row.json --out unchecked --set development.steps=120").out,
              ::testing::Not(HasSubstr("renewals")));
}

TEST_F(Program, GrowReplacesOnlyWhenTold) {
  const std::string grow = "grow dead.json --out d --set development.steps=60 --at 60";
  EXPECT_EQ(run(grow).exit_code, 0);
  const std::string before = tests::text_of(here() / "d" / "embryo-0060.json");
  write_file(here() / "d" / "embryo-0060.json", "mine", Overwrite::yes);
  const auto refused = run(grow);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err_lines(),
              ElementsAre(StartsWith("d/embryo-0060.json: exists already: expected"),
                          StartsWith("d/development.svg: exists already: expected")));
  EXPECT_EQ(tests::text_of(here() / "d" / "embryo-0060.json"), "mine");
  EXPECT_EQ(run(grow + " --overwrite").exit_code, 0);
  EXPECT_EQ(tests::text_of(here() / "d" / "embryo-0060.json"), before);
}

TEST_F(Program, ABodyMovesAsItsGenomeDoes) {
  const std::string rules = " --set development.steps=300 --json";
  const auto grown = json_lines(run("grow blob.json --out b --at 300" + rules).out);
  ASSERT_EQ(grown.size(), 1u);
  ASSERT_EQ(grown[0]["status"], "ok") << grown[0];
  const auto result =
      run("simulate blob.json b/body-0300.json dead.json row.json --steps 200" + rules);
  const auto lines = json_lines(result.out);
  ASSERT_EQ(lines.size(), 4u) << result.err;
  Json genome = lines[0], body = lines[1];
  EXPECT_EQ(genome["file"], "blob.json");
  EXPECT_EQ(body["file"], "b/body-0300.json");
  genome.erase("file");
  body.erase("file");
  EXPECT_EQ(genome, body);
  EXPECT_EQ(lines[2]["status"], "empty");
  EXPECT_EQ(lines[3]["status"], "no_body");
}

TEST_F(Program, SimulateChoosesStepsIfTold) {
  const auto result = run("simulate disc.json --scene land --dt auto --steps 50 --json");
  EXPECT_EQ(result.err, "");
  const auto lines = json_lines(result.out);
  ASSERT_EQ(lines.size(), 1u);
  core::Scene scene = core::land_scene();
  scene.run_steps = 50;
  scene.step = scene.settle_step = core::automatic_step;
  scene = core::with_chosen_steps(tests::disc_body(19), scene, core::Method::drift_kick_drift);
  EXPECT_EQ(lines[0]["step"], scene.step);
  EXPECT_EQ(lines[0]["settle_step"], scene.settle_step);
  // 10 time units in steps that meet their end, after those of settling.
  EXPECT_EQ(lines[0]["steps"],
            std::lround(lines[0]["settle_time"].get<double>() / scene.settle_step) +
                std::lround(10 / scene.step));
  // The trajectory tells the times that it took.
  EXPECT_EQ(run("simulate disc.json --dt auto --steps 50 --trajectory t.csv").exit_code, 0);
  std::string last, line;
  std::istringstream file(tests::text_of(here() / "t.csv"));
  while (std::getline(file, line)) last = line;
  EXPECT_NEAR(std::stod(last.substr(last.find(',') + 1)), 10, 2 * core::paper_step);
}

TEST_F(Program, SimulateWarnsOfStepsNearTheLimit) {
  const core::Body body = tests::disc_body(19);
  const auto limit = [&](double damping) {
    return core::step_limit(body, core::water_scene(), damping, core::Method::drift_kick_drift)
        .sharp;
  };
  const double water = limit(core::water_scene().damping);
  const auto simulate = [&](double step, const std::string& more) {
    return run("simulate disc.json --steps 20 --dt " + std::to_string(step) + " " + more);
  };
  EXPECT_THAT(simulate(0.93 * water, "").err_lines(),
              ElementsAre(AllOf(StartsWith("warning: disc.json: step "),
                                HasSubstr("is 93 % of the largest stable one"),
                                HasSubstr("expected at most 90 %; --dt auto"))));
  EXPECT_THAT(simulate(0.65 * water, "--scene land").err_lines(),
              ElementsAre(AllOf(HasSubstr("is 65 % of"), HasSubstr("expected at most 60 %"))));
  // Many bodies, one line.
  EXPECT_THAT(simulate(0.93 * water, "disc.json disc.json").err_lines(),
              ElementsAre(HasSubstr("and so for 3 of 3 bodies")));
  EXPECT_EQ(simulate(0.85 * water, "").err, "");
  EXPECT_EQ(simulate(0.45 * water, "--scene land").err, "");
  // Beyond the limit the outcome says it, no warning is needed.
  const auto refused = simulate(1.1 * water, "");
  EXPECT_EQ(refused.err, "");
  EXPECT_THAT(refused.out, HasSubstr("step_too_large"));
}

TEST_F(Program, SimulateRefusesStepsThatNoBodyBears) {
  const core::Body disc = tests::disc_body(19);
  expect_fault("simulate disc.json --dt 10 --steps 1",
               "disc.json: step 10: expected at most 0.2, the length of the run");
  core::Body fast = disc;
  fast.period[3] = 0.6;
  write_body(here() / "fast.json", fast, Overwrite::no);
  const std::string fault =
      "fast.json: step 0.2: expected at most 0.15, a quarter of the period of node 3";
  expect_fault("simulate disc.json fast.json", fault);
  expect_fault("simulate fast.json --trajectory t.csv", fault);
  EXPECT_FALSE(std::filesystem::exists(here() / "t.csv"));
  EXPECT_EQ(run("simulate fast.json --steps 5 --dt 0.15").exit_code, 0);
  EXPECT_EQ(run("simulate fast.json --steps 5 --dt auto").exit_code, 0);
  // Too short to be an oscillation.
  std::string text = tests::text_of(here() / "disc.json");
  text.replace(text.find("40", text.find("period")), 2, "1e-300");
  write_file(here() / "instant.json", text, Overwrite::no);
  expect_fault("simulate instant.json --dt auto",
               "instant.json: period[0]: 1e-300: expected a finite number >= 0.001");
}

TEST_F(Program, SimulateTellsLongWorkBeforeItStarts) {
  // Springs of five times their length tear the body apart long before the run is over.
  core::Body body = tests::disc_body(19);
  for (double& length : body.rest_length) length = 5;
  write_body(here() / "tense.json", body, Overwrite::no);
  const auto result = run("simulate tense.json --dt 1e-4 --steps 100000000 --threads 2");
  EXPECT_EQ(result.exit_code, 0);
  // 2e7 time units, 42 springs, 1.5 ns for each; a single body keeps a single thread busy.
  EXPECT_THAT(result.err_lines(),
              ElementsAre("long work: 2e+11 steps per body, about 3 h 30 min on 1 thread"));
  EXPECT_THAT(result.out, HasSubstr("failed at step "));
  EXPECT_EQ(run("simulate tense.json --dt 1e-4 --steps 1000000").err, "");
}

TEST_F(Program, ABodyThatMeetsItselfIsRefused) {
  // A C with a tooth whose tip lies on the other jaw.
  core::Body body;
  body.x = {0, 4, 4, 1, 1, 4, 4, 0, 2};
  body.y = {0, 0, 1, 1, 3, 3, 4, 4, 1};
  body.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 7}, {7, 4, 5}, {7, 5, 6}, {4, 8, 5}};
  core::set_rest_from_nodes(body);
  tests::set_wave(body);
  write_body(here() / "knot.json", body, Overwrite::no);
  expect_fault("simulate knot.json",
               "knot.json: outline edges [2, 3] and [4, 8]: node 8 lies on both: expected an "
               "outline that neither crosses nor touches itself");
}

TEST_F(Program, SimulatePrintsWhatTheLibrarySays) {
  const core::Body body = tests::disc_body(19);
  core::Scene scene = core::land_scene();
  scene.step = 0.05;
  scene.run_steps = 100;
  const core::LocomotionTask task = {&body, &scene};
  const core::LocomotionOptions options = {core::Precision::float64, core::Method::symplectic_euler,
                                           1};
  const core::Outcome outcome = core::simulate({&task, 1}, options).front();
  const auto result =
      run("simulate disc.json --scene land --dt 0.05 --steps 100 --threads 2 --json "
          "--set locomotion.precision=float64 --set locomotion.method=symplectic_euler");
  EXPECT_EQ(result.out, outcome_json({{"file", "disc.json"}, {"scene", "land"}}, outcome) + "\n");
  const Json line = Json::parse(result.out);
  EXPECT_EQ(line["status"], core::name(outcome.status));
  EXPECT_EQ(line["distance"].get<double>(), outcome.distance);
  EXPECT_EQ(line["mean_position"].get<std::vector<double>>(),
            std::vector(outcome.mean_position.begin(), outcome.mean_position.end()));
  EXPECT_EQ(line["steps"], outcome.steps);
  EXPECT_EQ(line["cells"], 19);
  EXPECT_EQ(line["near_step_limit"], outcome.near_step_limit);
  EXPECT_EQ(line["settle_step"], outcome.settle_step);
  EXPECT_FALSE(line.contains("failed_step"));
}

TEST_F(Program, ADirectoryIsOneBatchWithoutItsEmbryos) {
  EXPECT_EQ(run("grow blob.json --out many --at 0,300 --set development.steps=300").exit_code, 0);
  write_body(here() / "many" / "a.json", tests::disc_body(7), Overwrite::no);
  const auto lines = json_lines(run("simulate many --steps 10 --json").out);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0]["file"], "many/a.json");
  EXPECT_EQ(lines[1]["file"], "many/body-0300.json");
  const std::filesystem::path none = here() / "none";
  std::filesystem::create_directory(none);
  expect_fault("simulate none", "none: expected body or genome files (*.json) in it");
}

TEST_F(Program, TheTrajectoryEndsWhereTheOutcomeSays) {
  const auto result = run(
      "simulate disc.json --steps 50 --every 25 --set locomotion.precision=float64 --trajectory "
      "t.csv --json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::istringstream csv(tests::text_of(here() / "t.csv"));
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line, "step,time,node,x,y,vx,vy");
  std::vector<std::array<double, 2>> mean;  // of frames 0, 25, 50
  for (int row = 0; std::getline(csv, line); ++row) {
    std::vector<double> values;
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) values.push_back(std::stod(cell));
    ASSERT_EQ(values.size(), 7u);
    EXPECT_EQ(values[0], 25 * (row / 19));
    EXPECT_EQ(values[2], row % 19);
    if (row % 19 == 0) mean.push_back({0, 0});
    mean.back()[0] += values[3] / 19;
    mean.back()[1] += values[4] / 19;
  }
  ASSERT_EQ(mean.size(), 3u);
  const Json outcome = Json::parse(result.out);
  // Round-off of sums of 19 positions below 3 d.
  EXPECT_NEAR(outcome["mean_position"][0].get<double>(), mean[2][0] - mean[0][0], 1e-13);
  EXPECT_NEAR(outcome["mean_position"][1].get<double>(), mean[2][1] - mean[0][1], 1e-13);
}

}  // namespace
}  // namespace metamorph::evolve
