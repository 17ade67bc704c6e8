// What is wrong with an experiment is told in lines that name file, line, key and value.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/evolve/experiment_text.h"

namespace metamorph::evolve {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using tests::faults_of;
using tests::good;

/// A change to the good file, and the line it must cost.
struct Bad {
  std::string text;
  std::string line;
};

TEST(Experiment, EveryFaultGetsItsLine) {
  const std::string g = good;  // 9 lines
  const std::vector<Bad> table = {
      {g + "[neat]\npopulaton = 5\n",
       "x.toml:11: neat.populaton = 5: unknown key; did you mean neat.population?"},
      {"population = 5\n" + g,
       "x.toml:1: population = 5: unknown key; did you mean neat.population?"},
      {"qqqqqqqq = 5\n" + g, "x.toml:1: qqqqqqqq = 5: unknown key"},
      {g + "[scenes.land]\nground_stiffness = 4\n",
       "x.toml:11: scenes.land.ground_stiffness = 4: the ground is solid since version 0.2: "
       "expected no such key"},
      {"generations = \"many\"\n" + g,
       "x.toml:1: generations = \"many\": expected a whole number from 1 to 10000000"},
      {"generations = 1.5\n" + g,
       "x.toml:1: generations = 1.5: expected a whole number from 1 to 10000000"},
      {"generations = 0\n" + g,
       "x.toml:1: generations = 0: expected a whole number from 1 to 10000000"},
      {"seed = -1\n" + g,
       "x.toml:1: seed = -1: expected a whole number from 0 to 9007199254740992"},
      {g + "[neat]\ncrossover = 1.5\n",
       "x.toml:11: neat.crossover = 1.5: expected a number from 0 to 1"},
      {g + "[neat]\ncrossover = nan\n",
       "x.toml:11: neat.crossover = nan: expected a number from 0 to 1"},
      {g + "[neat]\ncrossover = true\n",
       "x.toml:11: neat.crossover = true: expected a number from 0 to 1"},
      {g + "[search]\nkind = \"newness\"\n",
       "x.toml:11: search.kind = \"newness\": expected one of \"simple\", \"progressive\", "
       "\"novelty\", \"map-elites\", \"nslc\", \"dns\", \"nsga2\""},
      {g + "[scenes.water]\ndrag = 1\n",
       "x.toml:11: scenes.water.drag = 1: expected true or false"},
      {g + "[scenes.slope]\nfriction = 1\n",
       "x.toml:10: scenes.slope: expected a scene that a trial names"},
      {g + "[scenes.water]\nfrction = 1\n",
       "x.toml:11: scenes.water.frction = 1: unknown key; did you mean scenes.water.friction?"},
      {g + "[scenes.water]\nbase = \"air\"\n",
       "x.toml:11: scenes.water.base = \"air\": expected one of \"water\", \"land\", "
       "\"land-right\", \"slope\""},
      {"neat = 3\n" + g, "x.toml:1: neat = 3: expected a table [neat]"},
      {"trials = 3\nname = \"x\"\n", "x.toml:1: trials = 3: expected a list of tables [[trials]]"},
      {"name = \"x/y\"\n" + g.substr(g.find('\n') + 1),
       "x.toml:1: name = \"x/y\": expected a name of letters, digits, '-', '_' and '.', in quotes"},
      {g.substr(g.find('\n') + 1),
       "x.toml: name is missing: expected a name of letters, digits, '-', '_' and '.', in quotes"},
      {"name = \"x\"\n", "x.toml: trials: expected a [[trials]] table at least, there is none"},
      {g + "[search]\nkind = \"novelty\"\narchive_floor = 2\n",
       "x.toml:12: search.archive_floor = 2: expected at most search.archive_threshold = 1"},
      {"name = \"x\"\n[search]\nkind = \"progressive\"\n" + g.substr(g.find('\n') + 1) +
           "[[trials]]\nname = \"third\"\nstage = 900\nscene = \"land\"\n",
       "x.toml:10: trials.adult.stage = 1200: expected at most trials.third.stage = 900: "
       "progressive search starts with the earlier stage"},
      {"name = \"x\"\n[[trials]]\nname = \"a\"\nstage = 1300\nscene = \"water\"\n",
       "x.toml:4: trials.a.stage = 1300: expected at most development.steps = 1200"},
      {"name = \"x\"\n[[trials]]\nname = \"a\"\nstage = 600\nscene = \"lava\"\n",
       "x.toml:5: trials.a.scene = \"lava\": expected water, land, land-right, slope or the name "
       "of a [scenes.NAME] table"},
      {"name = \"x\"\n[[trials]]\nname = \"a\"\nscene = \"water\"\n",
       "x.toml:2: trials.a: stage is missing"},
      {g + "starts = 0\n",
       "x.toml:10: trials.adult.starts = 0: expected a whole number from 1 to 1000"},
      {g + "starts = 1001\n",
       "x.toml:10: trials.adult.starts = 1001: expected a whole number from 1 to 1000"},
      {g + "starts = 2.5\n",
       "x.toml:10: trials.adult.starts = 2.5: expected a whole number from 1 to 1000"},
      {g + "start_displacement = -1e-3\n",
       "x.toml:10: trials.adult.start_displacement = -0.001: expected a number from 0 to 1"},
      {g + "starts_combine = \"most\"\n",
       "x.toml:10: trials.adult.starts_combine = \"most\": expected one of \"mean\", \"median\", "
       "\"least\""},
      {g + "starts_renew = 1\n",
       "x.toml:10: trials.adult.starts_renew = 1: expected true or false"},
      {g + "start = 3\n",
       "x.toml:10: trials.adult.start = 3: unknown key; did you mean trials.adult.starts?"},
      {g + "starts = 2\nstart_displacement = 0\n",
       "x.toml:11: trials.adult.start_displacement = 0: expected more than 0: all starts would be "
       "one"},
      {g + "starts_renew = true\nstart_displacement = 0\n",
       "x.toml:11: trials.adult.start_displacement = 0: expected more than 0: all starts would be "
       "one"},
      {"name = \"x\"\n[search]\nkind = \"progressive\"\n[[trials]]\nname = \"a\"\nstage = 1\n"
       "scene = \"water\"\n",
       "x.toml:3: search.kind = \"progressive\": expected simple or novelty: progressive search "
       "needs trials of two stages at least (larva, adult), there is 1 trial"},
      {g + "[development]\nperiod_min = 200\n",
       "x.toml:11: development.period_min = 200: expected at most development.period_max = 120"},
      {g + "[development]\nperiod_min = 0.6\n",
       "x.toml: scenes.water.step = 0.2: expected at most development.period_min / 4 = 0.15"},
      {g + "[scenes.water]\nstep = 1\nrun_steps = 4\nramp_steps = 1\n",
       "x.toml:11: scenes.water.step = 1: expected at most scenes.water.run_steps * 0.2 = 0.8"},
      {g + "[neat]\nspecies_max = 3\n",
       "x.toml: neat.species_min = 15: expected at most neat.species_max = 3"},
      {g + "[neat]\nseparation = \"half\"\n",
       "x.toml:11: neat.separation = \"half\": expected one of \"none\", \"partial\", \"full\""},
      {"name = \"x\"\n[neat]\nseparation = \"full\"\n"
       "[[trials]]\nname = \"a\"\nstage = 600\nscene = \"water\"\n"
       "[[trials]]\nname = \"b\"\nstage = 600\nscene = \"land\"\n",
       "x.toml:3: neat.separation = \"full\": expected none: life has one stage, so nothing can be "
       "separated"},
      {g + "[neat]\nmutate_weights = 0\n",
       "x.toml:11: neat.mutate_weights = 0: expected more than 0: the other mutations can all "
       "fail"},
  };
  for (const Bad& bad : table) {
    EXPECT_THAT(faults_of(bad.text), ElementsAre(bad.line)) << bad.text;
  }
}

TEST(Experiment, AllFaultsAreToldAtOnce) {
  const std::vector<std::string> faults =
      faults_of(std::string("generations = 0\nfoo = 1\n") + good + "[neat]\nsevere = 2\nx = 1\n",
                {parse_override("neat.young_bonus=no"), parse_override("scenes.mars.friction=1")});
  EXPECT_THAT(faults, testing::UnorderedElementsAre(
                          HasSubstr("x.toml:1: generations"), HasSubstr("x.toml:2: foo"),
                          HasSubstr("x.toml:13: neat.severe"), HasSubstr("x.toml:14: neat.x"),
                          "--set: neat.young_bonus = \"no\": expected a number from 0 to 1000000",
                          HasSubstr("--set: scenes.mars.friction = 1: unknown key")));
}

// As many as one reads, each of them short.
TEST(Experiment, FaultsWithoutEndAreCounted) {
  const std::string name(5000, 'q');
  std::string text = name + " = 1\n[[trials]]\nname = \"" + name + "\"\n";
  for (int i = 0; i < 150; ++i) text += "no" + std::to_string(i) + " = 1\n";
  const std::vector<std::string> faults = faults_of(text);
  ASSERT_EQ(faults.size(), 101u);
  for (const std::string& line : faults) EXPECT_LT(line.size(), 1000u) << line;
  EXPECT_THAT(faults.back(), testing::MatchesRegex("x.toml: and [0-9]+ more"));
}

TEST(Experiment, TextThatIsNoTomlIsPlaced) {
  EXPECT_THAT(faults_of("name = \"x\"\ngenerations = = 3\n"),
              ElementsAre(HasSubstr("x.toml:2: not valid TOML")));
  EXPECT_THROW(read_experiment("no/such/file.toml"), InputError);
  EXPECT_THROW(read_experiment("/"), InputError);
  for (const char* text : {"", "=", "a=", "=3", "abc"}) {
    EXPECT_THROW(parse_override(text), InputError) << text;
  }
}

}  // namespace
}  // namespace metamorph::evolve
