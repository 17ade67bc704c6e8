// Inputs and outputs of the control network as an experiment names them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "evolve/experiment/experiment_file.h"
#include "tests/evolve/files.h"

namespace metamorph::evolve {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* good =
    "name = \"x\"\n[[trials]]\nname = \"larva\"\nstage = 600\nscene = \"water\"\n";

std::vector<std::string> faults_of(const std::vector<Override>& overrides) {
  return tests::lines_of([&] { parse_experiment(good, "x.toml", overrides); });
}

TEST(Experiment, SignalsOfTheControlNetwork) {
  using core::Input;
  const std::string g = good;
  EXPECT_EQ(parse_experiment(g, "x.toml").development.inputs, core::paper_inputs());
  EXPECT_EQ(parse_experiment(g, "x.toml").development.outputs, core::paper_outputs());
  // The order in which they are written decides nothing.
  const Experiment e = parse_experiment(
      g + "[development]\ninputs = [\"neighbours\", \"bias\", \"x\"]\noutputs = [\"phase\", "
          "\"angle\"]\n",
      "x.toml");
  EXPECT_THAT(e.development.inputs, ElementsAre(Input::x, Input::bias, Input::neighbours));
  EXPECT_THAT(e.development.outputs, ElementsAre(core::Output::angle, core::Output::phase));
  EXPECT_THAT(to_toml(e), HasSubstr("\ninputs = [\"x\", \"bias\", \"neighbours\"]\n"
                                    "outputs = [\"angle\", \"phase\"]\n"));
  const Experiment back = parse_experiment(to_toml(e), "again");
  EXPECT_EQ(back.development.inputs, e.development.inputs);
  EXPECT_EQ(back.development.outputs, e.development.outputs);
  const Experiment set =
      parse_experiment(g, "x.toml", {{"--set", "development.inputs", "[\"bias\", \"time\"]"}});
  EXPECT_THAT(set.development.inputs, ElementsAre(Input::time, Input::bias));
  EXPECT_THAT(describe_keys(), HasSubstr("\n    neighbours: number of linked neighbours / 6"));
}

TEST(Experiment, SignalsThatCannotBeAreToldInOneLine) {
  const auto fault = [](const std::string& key, const std::string& value) {
    return faults_of({{"--set", "development." + key, value}});
  };
  const std::string inputs =
      "expected a list of one or more of \"time\", \"x\", \"y\", \"morphogen_1\", "
      "\"morphogen_2\", \"bias\", \"neighbours\", each once, with \"bias\"";
  const std::string outputs =
      "expected a list of one or more of \"inhibit\", \"angle\", \"die\", \"morphogen_1\", "
      "\"morphogen_2\", \"period\", \"phase\", each once";
  const std::string at = "--set: development.inputs = ";
  EXPECT_THAT(fault("inputs", "[]"), ElementsAre(at + "an empty list: " + inputs));
  EXPECT_THAT(fault("inputs", "6"), ElementsAre(at + "6: " + inputs));
  EXPECT_THAT(fault("inputs", "bias"), ElementsAre(at + "\"bias\": " + inputs));
  EXPECT_THAT(fault("inputs", "[1, 2]"), ElementsAre(at + "a list: " + inputs));
  EXPECT_THAT(fault("inputs", "[\"bias\", \"smell\"]"),
              ElementsAre(at + "a list: \"smell\" is unknown: " + inputs));
  EXPECT_THAT(fault("inputs", "[\"bias\", \"x\", \"x\"]"),
              ElementsAre(at + "a list: \"x\" stands twice: " + inputs));
  EXPECT_THAT(fault("inputs", "[\"time\", \"x\"]"),
              ElementsAre(at + "a list: \"bias\" is missing: " + inputs));
  EXPECT_THAT(fault("outputs", "[]"),
              ElementsAre("--set: development.outputs = an empty list: " + outputs));
  EXPECT_THAT(fault("outputs", "[\"bias\"]"),
              ElementsAre("--set: development.outputs = a list: \"bias\" is unknown: " + outputs));
}

}  // namespace
}  // namespace metamorph::evolve
