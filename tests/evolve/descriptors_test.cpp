// What describes an individual beside where it ended: names, values, and the page that defines
// them.

#include "metamorph/descriptors.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "evolve/evaluation/describe.h"
#include "evolve/experiment/experiment.h"
#include "metamorph/shape.h"
#include "tests/bodies.h"
#include "tests/evolve/runs.h"

namespace metamorph::evolve {
namespace {

using testing::HasSubstr;
using tests::networks_of;
using tests::tiny_experiment;
using tests::tiny_newt;

std::vector<std::string> names_of(const Problem& problem) {
  std::vector<std::string> names;
  for (const Descriptor& descriptor : problem.descriptors) names.push_back(descriptor.name);
  return names;
}

/// One trial after the other, then one metamorphosis after the other.
std::vector<std::string> expected_names(const std::vector<std::string>& trials,
                                        const std::vector<std::string>& metamorphosed) {
  std::vector<std::string> names;
  for (const std::string& trial : trials) {
    names.push_back(trial + ".x");
    names.push_back(trial + ".y");
  }
  for (const std::string& trial : trials) {
    for (const char* name : {"cells", "elongation", "compactness", "symmetry", "limbs", "height",
                             "mean_period", "phase_coherence", "stance", "gait_frequency"}) {
      names.push_back(trial + "." + name);
    }
  }
  for (const std::string& trial : metamorphosed) {
    for (const char* name : {"growth", "turnover", "reshaping"})
      names.push_back(trial + "." + name);
  }
  return names;
}

TEST(Descriptors, OfAProblemComeAfterPositions) {
  const Experiment two = tiny_experiment("simple", 2);
  EXPECT_EQ(names_of(problem_of(rules_of(two), 2)), expected_names({"larva", "adult"}, {"adult"}));
  Experiment newt = tiny_newt("simple", 2);
  EXPECT_EQ(names_of(problem_of(rules_of(newt), 2)),
            expected_names({"larva", "adult", "newt"}, {"adult", "newt"}));
  newt.trials[1].stage = newt.trials[0].stage;  // a larva in two scenes
  EXPECT_EQ(names_of(problem_of(rules_of(newt), 2)),
            expected_names({"larva", "adult", "newt"}, {"newt"}));
}

TEST(Descriptors, OfAProblemHaveRangesAndTrials) {
  Experiment e = tiny_newt("simple", 2);
  e.development.period_min = 20;
  e.development.period_max = 50;
  const Problem problem = problem_of(rules_of(e), 2);
  for (std::size_t d = 0; d < problem.descriptors.size(); ++d) {
    const Descriptor& descriptor = problem.descriptors[d];
    EXPECT_LT(descriptor.low, descriptor.high) << descriptor.name;
    EXPECT_EQ(descriptor.is_position, d < 6) << descriptor.name;
    const std::string& trial = e.trials[static_cast<std::size_t>(descriptor.objective)].name;
    EXPECT_EQ(descriptor.name.substr(0, trial.size() + 1), trial + ".");
    if (descriptor.name == "adult.cells") {
      EXPECT_EQ(descriptor.high, e.development.max_cells);
    }
    if (descriptor.name == "adult.mean_period") {
      EXPECT_EQ(descriptor.low, 20);
      EXPECT_EQ(descriptor.high, 50);
    }
  }
}

core::Embryo embryo(int cells, int created, int died) {
  core::Embryo result;
  result.id.resize(static_cast<std::size_t>(cells));
  result.created = created;
  result.died = died;
  return result;
}

EvaluationRules rules_of_stages(const std::vector<int>& stages) {
  EvaluationRules rules;
  for (const int stage : stages) {
    Trial trial;
    trial.name = std::to_string(stage);
    trial.stage = stage;
    rules.trials.push_back(trial);
  }
  return rules;
}

TEST(Descriptors, StageBeforeIsTheNextBelow) {
  const EvaluationRules rules = rules_of_stages({600, 600, 900, 1200});
  EXPECT_EQ(stage_before(rules, 600), -1);
  EXPECT_EQ(stage_before(rules, 900), 600);
  EXPECT_EQ(stage_before(rules, 1200), 900);
}

TEST(Descriptors, OfAMetamorphosisAreThoseOfKnownCounts) {
  const EvaluationRules rules = rules_of_stages({600, 900, 1200});
  const std::vector<int> stages = {600, 900, 1200};
  // 18 are born and 8 die: 20 become 30; then nothing happens.
  const std::vector<core::Embryo> embryos = {embryo(20, 22, 2), embryo(30, 40, 10),
                                             embryo(30, 40, 10)};
  const core::Extraction ring{core::Status::ok, tests::ring_body(5, 8)};
  const core::Extraction disc{core::Status::ok, tests::disc_body(31)};
  const auto described =
      describe_stages(rules, stages, embryos, std::vector<core::Extraction>{ring, disc, disc});
  EXPECT_TRUE(std::isnan(described[0].growth));
  EXPECT_TRUE(std::isnan(described[0].turnover));
  EXPECT_TRUE(std::isnan(described[0].reshaping));
  EXPECT_EQ(described[1].growth, 1.5);
  EXPECT_EQ(described[1].turnover, 26.0 / 20);
  EXPECT_EQ(described[1].reshaping, 1);  // it would fit into the hole
  EXPECT_EQ(described[2].growth, 1);
  EXPECT_EQ(described[2].turnover, 0);
  EXPECT_EQ(described[2].reshaping, 0);
  EXPECT_EQ(described[2].cells, disc.body.node_count());
}

TEST(Descriptors, OfWhatIsNotThereSayNothing) {
  const EvaluationRules rules = rules_of_stages({600, 900, 1200});
  const core::Extraction body{core::Status::ok, tests::disc_body(31)},
      none{core::Status::empty, {}};
  const std::vector<core::Embryo> embryos = {embryo(0, 1, 1), embryo(31, 31, 0)};
  const auto after_nothing = describe_stages(rules, std::vector<int>{600, 900}, embryos,
                                             std::vector<core::Extraction>{none, body});
  EXPECT_TRUE(std::isnan(after_nothing[0].cells));
  EXPECT_EQ(after_nothing[1].cells, 31);
  EXPECT_TRUE(std::isnan(after_nothing[1].growth));
  // Where the stage between them was not looked at it is no single metamorphosis.
  const auto leap = describe_stages(rules, std::vector<int>{600, 1200}, embryos,
                                    std::vector<core::Extraction>{body, body});
  EXPECT_EQ(leap[1].cells, 31);
  EXPECT_TRUE(std::isnan(leap[1].reshaping));

  TrialDescriptors descriptors = leap[1];
  core::Outcome outcome;
  outcome.height = 3;
  outcome.stance = 0.5;
  outcome.gait_frequency = 0.03;
  describe_motion(descriptors, outcome);
  EXPECT_EQ(descriptors.height, 3);
  EXPECT_EQ(descriptors.stance, 0.5);
  EXPECT_EQ(descriptors.gait_frequency, 0.03);
  outcome.status = core::Status::crossed;
  describe_motion(descriptors, outcome);
  EXPECT_TRUE(std::isnan(descriptors.height));
  EXPECT_TRUE(std::isnan(descriptors.stance));
  EXPECT_TRUE(std::isnan(descriptors.gait_frequency));
  EXPECT_EQ(descriptors.cells, 31);
}

/// Every descriptor of an individual again, step by step.
std::vector<double> by_hand(const core::Network& network, const Experiment& e,
                            const Evaluated& evaluated) {
  const core::LocomotionOptions one_thread{e.locomotion.precision, e.locomotion.method, 1};
  std::vector<double> positions, described, metamorphoses;
  core::Body before;
  core::Embryo embryo_before;
  for (std::size_t t = 0; t < e.trials.size(); ++t) {
    const std::vector<int> stage = {e.trials[t].stage};
    const core::Embryo embryo = core::develop({&network, 1}, e.development, stage, 1)[0][0];
    const core::Body body = core::extract_body(embryo, e.min_cells).body;
    const core::LocomotionTask task = {&body, &e.scene_of(e.trials[t])};
    const core::Outcome outcome = core::simulate({&task, 1}, one_thread)[0];
    const core::Shape shape = core::shape_of(body);
    positions.insert(positions.end(), outcome.mean_position.begin(), outcome.mean_position.end());
    described.insert(
        described.end(),
        {static_cast<double>(body.node_count()), shape.elongation, shape.compactness,
         shape.symmetry, static_cast<double>(shape.limbs), outcome.height, shape.mean_period,
         shape.phase_coherence, outcome.stance, outcome.gait_frequency});
    if (t > 0) {
      const double cells = embryo_before.cell_count();
      const int born = embryo.created - embryo_before.created;
      const int died = embryo.died - embryo_before.died;
      metamorphoses.insert(metamorphoses.end(), {embryo.cell_count() / cells, (born + died) / cells,
                                                 1 - core::overlap(before, body)});
      EXPECT_NEAR(evaluated.descriptors[t].growth, 1 + (born - died) / cells, 1e-12);
    }
    before = body;
    embryo_before = embryo;
  }
  positions.insert(positions.end(), described.begin(), described.end());
  positions.insert(positions.end(), metamorphoses.begin(), metamorphoses.end());
  return positions;
}

TEST(Descriptors, OfAnEvaluationAreThoseOfItsBodiesAndMotions) {
  const Experiment e = tiny_newt("simple", 2);
  NeatSettings settings = e.neat;
  settings.population = 120;  // few genomes without a history have bodies
  const std::vector<Genome> genomes = first_generation(settings, 5).genomes;
  const std::vector<core::Network> networks = networks_of(genomes);
  const std::vector<std::uint8_t> all = {1, 1, 1};
  const auto results = Evaluator(rules_of(e), 1).evaluate(networks, all, 0);
  const Problem problem = problem_of(rules_of(e), 2);
  int whole = 0;
  for (std::size_t i = 0; i < genomes.size(); ++i) {
    const Evaluation evaluation = evaluation_of(results[i]);
    if (evaluation.descriptors.empty()) continue;
    ++whole;
    ASSERT_EQ(evaluation.descriptors.size(), problem.descriptors.size());
    EXPECT_EQ(evaluation.descriptors, by_hand(networks[i], e, results[i]));
  }
  EXPECT_GE(whole, 3);
}

TEST(Descriptors, AreKnownOfTheTrialsThatRan) {
  const Experiment e = tiny_experiment("simple", 2);
  NeatSettings settings = e.neat;
  settings.population = 60;
  const std::vector<core::Network> networks = networks_of(first_generation(settings, 5).genomes);
  const std::vector<std::uint8_t> adults = {0, 1};
  int bodies = 0;
  for (const Evaluated& one : Evaluator(rules_of(e), 1).evaluate(networks, adults, 0)) {
    EXPECT_TRUE(std::isnan(one.descriptors[0].cells));
    EXPECT_TRUE(std::isnan(one.descriptors[1].growth));
    EXPECT_TRUE(evaluation_of(one).descriptors.empty());
    bodies += !std::isnan(one.descriptors[1].cells);
  }
  EXPECT_GT(bodies, 0);
}

// "| name | unit | meaning | low to high |" of MODEL section 9.
TEST(Descriptors, AreDefinedInTheModelsPage) {
  std::ifstream file(METAMORPH_MODEL_PAGE);
  std::stringstream text;
  text << file.rdbuf();
  const std::string page = text.str();
  ASSERT_THAT(page, HasSubstr("## 9. Descriptors"));
  const std::string section = page.substr(page.find("## 9. Descriptors"));
  std::set<std::string_view> names;
  for (const DescriptorField& field : descriptor_fields) {
    EXPECT_TRUE(names.insert(field.name).second) << field.name;
    EXPECT_FALSE(field.meaning.empty()) << field.name;
    EXPECT_LT(field.low, field.high) << field.name;
    EXPECT_THAT(section, HasSubstr(fmt::format("| `{}` | {} | {} to {} |", field.name, field.unit,
                                               field.low, field.high)));
  }
}

}  // namespace
}  // namespace metamorph::evolve
