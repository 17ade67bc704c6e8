// --experiment, --set, --trial and --scene of grow, simulate and render, as a person would give
// them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "evolve/files/body_file.h"
#include "evolve/files/genome_file.h"
#include "evolve/files/outcome_json.h"
#include "metamorph/development.h"
#include "metamorph/extraction.h"
#include "metamorph/locomotion.h"
#include "tests/bodies.h"
#include "tests/evolve/plain_genomes.h"
#include "tests/evolve/program.h"

namespace metamorph::evolve {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using tests::blob_genome;
using tests::Json;
using tests::run_program;

/// The blob with an input of its own, which slows division where it is crowded.
Genome crowd_genome() {
  Genome genome = blob_genome();
  genome.nodes.insert(genome.nodes.begin(), {node_id(core::Input::neighbours), NodeKind::input});
  genome.links.push_back({7, -1, 6, 3.0});
  genome.links.push_back({8, 5, 6, -2.0});
  return genome;
}

constexpr const char* experiment_text =
    "name = \"pond\"\n"
    "[development]\nsteps = 400\nmax_cells = 40\n"
    "[body]\nmin_cells = 6\n"
    "[locomotion]\nprecision = \"float64\"\n"
    "[[trials]]\nname = \"tadpole\"\nstage = 240\nscene = \"pond\"\n"
    "[[trials]]\nname = \"frog\"\nstage = 390\nscene = \"land\"\n"
    "[scenes.pond]\nbase = \"water\"\nrun_steps = 150\ndrag_normal = 0.3\n"
    "[scenes.land]\nrun_steps = 100\nsettle_quiet_steps = 20\nsettle_max_steps = 60\n";

core::Scene pond_scene() {
  core::Scene scene = core::water_scene();
  scene.name = "pond";
  scene.run_steps = 150;
  scene.drag_normal = 0.3;
  return scene;
}

class Rules : public ::testing::Test {
 protected:
  Rules() {
    write_genome(here() / "blob.json", blob_genome(), Overwrite::no);
    write_genome(here() / "crowd.json", crowd_genome(), Overwrite::no);
    write_body(here() / "disc.json", tests::disc_body(19), Overwrite::no);
    write_file(here() / "pond.toml", experiment_text, Overwrite::no);
  }
  const std::filesystem::path& here() const { return directory_.path(); }
  tests::ProgramResult run(const std::string& arguments) const {
    return run_program(here(), arguments);
  }
  Json outcome(const std::string& arguments) const {
    const auto result = run("simulate " + arguments + " --json");
    EXPECT_EQ(result.exit_code, 0) << arguments << ": " << result.err;
    return result.exit_code == 0 ? Json::parse(result.out) : Json();
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

/// What the library says of the blob's body at a stage of pond.toml, in a scene.
std::string expected(int stage, const core::Scene& scene) {
  core::DevelopmentRules rules;
  rules.steps = 400;
  rules.max_cells = 40;
  const std::vector<core::Network> networks = {compile(blob_genome())};
  const std::vector<int> stages = {stage};
  const core::Body body =
      core::extract_body(core::develop(networks, rules, stages, 1).front().front(), 6).body;
  EXPECT_GT(body.node_count(), 0);
  const core::LocomotionTask task = {&body, &scene};
  core::LocomotionOptions options;
  options.precision = core::Precision::float64;
  return outcome_json({{"file", "blob.json"}, {"scene", scene.name}},
                      core::simulate({&task, 1}, options).front()) +
         "\n";
}

TEST_F(Rules, SimulateTakesAllOfAnExperiment) {
  const std::string pond = "simulate blob.json --json --experiment pond.toml";
  const std::string tadpole = expected(240, pond_scene());
  EXPECT_EQ(run(pond).out, tadpole);  // the first trial
  EXPECT_EQ(run(pond + " --trial tadpole").out, tadpole);
  core::Scene land = core::land_scene();
  land.run_steps = 100;
  land.settle_quiet_steps = 20;
  land.settle_max_steps = 60;
  EXPECT_EQ(run(pond + " --trial frog").out, expected(390, land));
  // What is said on the command line goes before what the trial says.
  EXPECT_EQ(run(pond + " --trial frog --scene pond").out, expected(390, pond_scene()));
  EXPECT_EQ(run(pond + " --stage 390").out, expected(390, pond_scene()));
  EXPECT_EQ(run(pond + " --set trials.tadpole.stage=390").out, expected(390, pond_scene()));
  core::Scene shorter = pond_scene();
  shorter.run_steps = 50;
  shorter.step = 0.1;
  EXPECT_EQ(run(pond + " --steps 50 --dt 0.1").out, expected(240, shorter));
  EXPECT_EQ(run(pond + " --set scenes.pond.run_steps=50 --set scenes.pond.step=0.1").out,
            expected(240, shorter));
}

TEST_F(Rules, ABodyMovesInTheSceneOfTheTrial) {
  const core::Body body = tests::disc_body(19);
  const core::Scene scene = pond_scene();
  const core::LocomotionTask task = {&body, &scene};
  core::LocomotionOptions options;
  options.precision = core::Precision::float64;
  const core::Outcome moved = core::simulate({&task, 1}, options).front();
  EXPECT_EQ(run("simulate disc.json --json --experiment pond.toml").out,
            outcome_json({{"file", "disc.json"}, {"scene", "pond"}}, moved) + "\n");
}

TEST_F(Rules, SetChangesTheDefaultExperiment) {
  const std::string disc = "disc.json --steps 60";
  EXPECT_EQ(outcome(disc)["scene"], "water");
  EXPECT_EQ(outcome(disc + " --trial larva"), outcome(disc));
  EXPECT_EQ(outcome(disc + " --trial adult"), outcome(disc + " --scene land"));
  const Json thick = outcome(disc + " --set scenes.water.drag_normal=5");
  EXPECT_NE(thick["distance"], outcome(disc)["distance"]);
  EXPECT_EQ(outcome(disc + " --set scenes.*.drag_normal=5"), thick);
  // Of any scene that is named.
  EXPECT_NE(outcome(disc + " --scene slope --set scenes.slope.slope_degrees=0"),
            outcome(disc + " --scene slope"));
  EXPECT_EQ(outcome("disc.json --set scenes.water.run_steps=60"), outcome(disc));
}

TEST_F(Rules, StagesOfTheDefaultExperimentFollowItsLength) {
  const auto steps = [&](const std::string& arguments) {
    std::istringstream lines(run("grow blob.json --json --overwrite " + arguments).out);
    std::vector<int> result;
    for (std::string line; std::getline(lines, line);) {
      result.push_back(Json::parse(line)["step"].get<int>());
    }
    return result;
  };
  EXPECT_THAT(steps("--set development.steps=300"), ElementsAre(150, 300));
  EXPECT_THAT(steps("--set development.steps=300 --set trials.larva.stage=90"),
              ElementsAre(90, 300));
  EXPECT_THAT(steps("--set development.steps=1"), ElementsAre(1));
  EXPECT_THAT(steps("--experiment pond.toml"), ElementsAre(240, 390));
  EXPECT_THAT(steps("--experiment pond.toml --at 10"), ElementsAre(10));
}

TEST_F(Rules, GrowTakesTheRulesOfDevelopment) {
  const auto cells = [&](const std::string& arguments) {
    const auto grown = run("grow blob.json --json --at 390 " + arguments);
    EXPECT_EQ(grown.exit_code, 0) << grown.err;
    return Json::parse(grown.out)["embryo_cells"].get<int>();
  };
  EXPECT_EQ(cells("--experiment pond.toml --set development.max_cells=20 --out a"), 20);
  EXPECT_EQ(cells("--set development.steps=400 --set development.max_cells=20 --out b"), 20);
  EXPECT_GT(cells("--experiment pond.toml --out d"), 20);
  EXPECT_EQ(tests::text_of(here() / "a" / "body-0390.json"),
            tests::text_of(here() / "b" / "body-0390.json"));
  // Too few cells are no body.
  const auto none =
      run("grow blob.json --experiment pond.toml --set body.min_cells=40 --at 60 --out c --json");
  EXPECT_EQ(Json::parse(none.out)["status"], "no_body");
}

TEST_F(Rules, AGenomeThatDoesNotFitIsRefusedInOneLine) {
  const std::string paper = "time, x, y, morphogen_1, morphogen_2, bias";
  const std::string line =
      "crowd.json: inputs: " + paper + ", neighbours: expected none but " + paper;
  for (const std::string& command :
       {std::string("grow crowd.json"), std::string("simulate crowd.json"),
        std::string("render crowd.json --out a.svg")}) {
    expect_fault(command, line);
    expect_fault(command + " --experiment pond.toml", line);
  }
  const std::string wide =
      " --set 'development.inputs=[\"time\", \"x\", \"y\", \"morphogen_1\", \"morphogen_2\", "
      "\"bias\", \"neighbours\"]'";
  EXPECT_EQ(run("grow crowd.json" + wide).exit_code, 0);
  EXPECT_EQ(run("render crowd.json --out a.svg --kind development" + wide).exit_code, 0);
  EXPECT_EQ(outcome("crowd.json --steps 20" + wide)["status"], "ok");
  // One that lacks the input is as it was.
  EXPECT_EQ(outcome("blob.json --steps 20" + wide), outcome("blob.json --steps 20"));
  // All files are told.
  const auto both = run("simulate crowd.json blob.json --set 'development.outputs=[\"angle\"]'");
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_THAT(both.err_lines(),
              ElementsAre(StartsWith("crowd.json: inputs: "), StartsWith("crowd.json: outputs: "),
                          "blob.json: outputs: inhibit, angle, die, morphogen_1, morphogen_2, "
                          "period, phase: expected none but angle"));
}

TEST_F(Rules, RenderTakesThemToo) {
  const std::string out = " --overwrite --out a.svg";
  const auto picture = [&](const std::string& arguments) {
    const auto result = run("render " + arguments + out);
    EXPECT_EQ(result.exit_code, 0) << arguments << ": " << result.err;
    return tests::text_of(here() / "a.svg");
  };
  // Text is drawn as shapes: pictures are told apart by all of it.
  const std::string pond = "blob.json --kind motion --experiment pond.toml";
  const std::string tadpole = picture(pond);
  EXPECT_TRUE(tadpole == picture(pond + " --trial tadpole"));
  EXPECT_FALSE(tadpole == picture(pond + " --trial frog"));
  EXPECT_FALSE(tadpole == picture(pond + " --set scenes.pond.amplitude=0"));
  EXPECT_FALSE(tadpole == picture("blob.json --kind motion"));
  const std::string disc = "disc.json --kind motion ",
                    single = " --set locomotion.precision=float32";
  EXPECT_FALSE(picture(disc) == picture(disc + "--experiment pond.toml"));
  EXPECT_TRUE(picture(disc + "--trial larva") == picture(disc));
  EXPECT_TRUE(picture(disc + "--trial adult") == picture(disc + "--scene land"));
  // A scene that the experiment does not change.
  EXPECT_TRUE(picture(disc + "--scene slope --experiment pond.toml" + single) ==
              picture(disc + "--scene slope"));
}

TEST_F(Rules, WhatCannotBeIsRefusedInOneLine) {
  for (const std::string& command :
       {std::string("grow blob.json"), std::string("simulate disc.json"),
        std::string("render blob.json --out a.svg"), std::string("render disc.json --out a.svg")}) {
    expect_fault(command + " --experiment none.toml",
                 "none.toml: no such file: expected a file that can be read");
    expect_fault(command + " --set development.stepps=3",
                 "--set: development.stepps = 3: unknown key; did you mean development.steps?");
    expect_fault(command + " --set locomotion.method=euler",
                 "--set: locomotion.method = \"euler\": expected one of \"drift_kick_drift\", "
                 "\"symplectic_euler\"");
    expect_fault(command + " --set steps",
                 "--set steps: expected key=value, as in neat.population=100");
    expect_fault(command + " --set development.max_cells=7",
                 "the default experiment: body.min_cells = 8: expected at most "
                 "development.max_cells = 7");
    expect_fault(command + " --set trials.adult.stage=1201",
                 "--set: trials.adult.stage = 1201: expected at most development.steps = 1200");
  }
  expect_fault("simulate disc.json --trial frog", "--trial: frog: expected larva or adult");
  expect_fault("simulate disc.json --trial adult --experiment pond.toml",
               "--trial: adult: expected tadpole or frog");
  expect_fault("simulate disc.json --scene moon",
               "--scene: moon: expected water, land, land-right or slope");
  expect_fault("simulate disc.json --scene moon --experiment pond.toml",
               "--scene: moon: expected water, land, land-right, slope or pond");
  expect_fault("simulate blob.json --stage 401 --experiment pond.toml",
               "--stage: 401: expected at most 400, the end of development");
  expect_fault("grow blob.json --at 401 --experiment pond.toml",
               "--at: 401: expected steps from 0 to 400, the end of development");
  expect_fault("render blob.json --out a.svg --scene land",
               "--scene: expected a body: a genome moves in the scene of its trial (--trial)");
  expect_fault("render blob.json --out a.svg --generation 3",
               "--generation: expected a run, not a genome");
  expect_fault("render disc.json --out a.svg --generation 3",
               "--generation: expected a run, not a body");
}

TEST_F(Rules, ARunIsShownByItsOwn) {
  ASSERT_EQ(run("evolve pond.toml --population 4 --generations 1 --out pond").exit_code, 0);
  const std::string why = ": not together with a run, which is shown by its own rules";
  for (const std::string& option :
       {std::string("--experiment pond.toml"), std::string("--set development.steps=9"),
        std::string("--scene land")}) {
    expect_fault("render pond --out a.svg " + option, option.substr(0, option.find(' ')) + why);
  }
  EXPECT_EQ(run("render pond --out a.svg --kind development --at 10,400").exit_code, 0);
}

}  // namespace
}  // namespace metamorph::evolve
