#include "metamorph/genome.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "tests/evolve/random_genomes.h"

namespace metamorph::evolve {
namespace {

using ::testing::ElementsAre;
using testing::hand_made;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::restless;
using testing::test_stream;
using testing::wander;

constexpr int input_count = 6;
constexpr int output_count = 7;
using Inputs = std::array<double, input_count>;
using Outputs = std::array<double, output_count>;

// What a genome means, straight from its genes: a node is the sigmoid of what its links bring.
Outputs evaluate_recursively(const Genome& genome, const Inputs& inputs) {
  const std::function<double(int)> value = [&](int node) -> double {
    if (node < input_count) return inputs[static_cast<std::size_t>(node)];
    double sum = 0;
    for (const LinkGene& link : genome.links) {
      if (link.to == node)
        sum += static_cast<double>(static_cast<float>(link.weight)) * value(link.from);
    }
    return std::tanh(sum / 2);
  };
  Outputs outputs;
  for (int o = 0; o < output_count; ++o) {
    outputs[static_cast<std::size_t>(o)] = value(input_count + o);
  }
  return outputs;
}

// What a compiled network means, as its header says.
Outputs evaluate(const core::Network& network, const Inputs& inputs) {
  std::vector<double> value(inputs.begin(), inputs.end());
  for (int n = 0; n < network.node_count(); ++n) {
    const std::size_t node = static_cast<std::size_t>(n);
    double sum = 0;
    for (int l = network.first_link[node]; l < network.first_link[node + 1]; ++l) {
      const std::size_t link = static_cast<std::size_t>(l);
      EXPECT_LT(network.source[link], input_count + n);
      sum += static_cast<double>(network.weight[link]) *
             value.at(static_cast<std::size_t>(network.source[link]));
    }
    value.push_back(std::tanh(sum / 2));
  }
  Outputs outputs;
  for (std::size_t o = 0; o < outputs.size(); ++o) {
    outputs[o] = value.at(static_cast<std::size_t>(network.output[o]));
  }
  return outputs;
}

TEST(Compile, AgreesWithARecursiveEvaluator) {
  // Few hidden nodes at first, so that the recursion stays short. The order of summation is the
  // same and left-out nodes add nothing, hence no tolerance.
  NeatSettings settings = restless();
  settings.hidden_nodes = 2;
  evolve::RandomStream stream = test_stream(1);
  for (const int rounds : {0, 3, 15, 40}) {
    for (const Genome& genome : wander(settings, 50, rounds, static_cast<std::uint32_t>(rounds))) {
      Inputs inputs;
      for (double& input : inputs) input = 2 * stream.triangular();
      ASSERT_EQ(evaluate(compile(genome), inputs), evaluate_recursively(genome, inputs));
    }
  }
}

TEST(Compile, OrdersByDepthThenId) {
  // 0 -> 15 -> 13 -> 6, 0 -> 14 -> 6, 0 -> 7: depth 1 holds 7, 14, 15 and the unlinked outputs are
  // of depth 0.
  const Genome genome = hand_made(
      {13, 14, 15},
      {{0, 0, 15, 1}, {1, 15, 13, 2}, {2, 13, 6, 3}, {3, 0, 14, 4}, {4, 14, 6, 5}, {5, 0, 7, 6}});
  const core::Network network = compile(genome);
  // Slots: 8-12 at 6-10, 7 at 11, 14 at 12, 15 at 13, 13 at 14, 6 at 15.
  EXPECT_THAT(network.output, ElementsAre(15, 11, 6, 7, 8, 9, 10));
  EXPECT_THAT(network.first_link, ElementsAre(0, 0, 0, 0, 0, 0, 1, 2, 3, 4, 6));
  EXPECT_THAT(network.source, ElementsAre(0, 0, 0, 13, 14, 12));
  EXPECT_THAT(network.weight, ElementsAre(6, 4, 1, 2, 3, 5));
}

TEST(Compile, LeavesOutWhatReachesNoOutput) {
  const Genome genome =
      hand_made({13, 14, 15}, {{0, 0, 13, 1}, {1, 13, 14, 1}, {2, 1, 15, 1}, {3, 15, 6, 1}});
  EXPECT_EQ(compile(genome).node_count(), output_count + 1);
}

TEST(Compile, AnUnlinkedHiddenNodeIsZero) {
  const Genome genome = hand_made({13}, {{0, 13, 6, 5}, {1, bias_input, 6, 1}});
  EXPECT_EQ(evaluate(compile(genome), {0, 0, 0, 0, 0, 1})[0], std::tanh(0.5));
}

TEST(SignalIds, NeverChange) {
  using core::Input;
  using core::Output;
  EXPECT_EQ(node_id(Input::time), 0);
  EXPECT_EQ(node_id(Input::x), 1);
  EXPECT_EQ(node_id(Input::y), 2);
  EXPECT_EQ(node_id(Input::morphogen_1), 3);
  EXPECT_EQ(node_id(Input::morphogen_2), 4);
  EXPECT_EQ(node_id(Input::bias), 5);
  EXPECT_EQ(node_id(Input::neighbours), -1);
  EXPECT_EQ(node_id(Output::inhibit), 6);
  EXPECT_EQ(node_id(Output::angle), 7);
  EXPECT_EQ(node_id(Output::die), 8);
  EXPECT_EQ(node_id(Output::morphogen_1), 9);
  EXPECT_EQ(node_id(Output::morphogen_2), 10);
  EXPECT_EQ(node_id(Output::period), 11);
  EXPECT_EQ(node_id(Output::phase), 12);
  EXPECT_EQ(kind_of(-1), NodeKind::input);
  EXPECT_EQ(kind_of(13), NodeKind::hidden);
  EXPECT_EQ(kind_of(least_id - 1), std::nullopt);
}

TEST(SignalIds, AnotherInputShiftsNoneInTheFirstGenome) {
  evolve::RandomStream stream = test_stream(4);
  const Genome narrow = seed_genome({}, stream);
  const Genome wide = seed_genome({}, stream, testing::with_neighbours());
  EXPECT_THAT(check(wide), IsEmpty());
  ASSERT_EQ(wide.nodes.size(), narrow.nodes.size() + 1);
  EXPECT_EQ(wide.nodes.front(), (NodeGene{-1, NodeKind::input}));
  EXPECT_TRUE(std::equal(narrow.nodes.begin(), narrow.nodes.end(), wide.nodes.begin() + 1));
  EXPECT_EQ(std::count_if(wide.links.begin(), wide.links.end(),
                          [](const LinkGene& link) { return link.from == -1; }),
            8);  // to every hidden node
}

TEST(Compile, AGenomeWithoutAnInputIsOneWithoutLinksFromIt) {
  for (const Genome& genome : wander(restless(), 20, 20, 6)) {
    const core::Network narrow = compile(genome);
    const core::Network wide = compile(genome, testing::with_neighbours());
    Genome with_node = genome;
    with_node.nodes.insert(with_node.nodes.begin(), {-1, NodeKind::input});
    EXPECT_THAT(check(with_node), IsEmpty());
    const core::Network same = compile(with_node, testing::with_neighbours());
    ASSERT_EQ(wide.inputs, input_count + 1);
    EXPECT_EQ(wide.first_link, narrow.first_link);
    EXPECT_EQ(wide.weight, narrow.weight);
    for (std::size_t l = 0; l < wide.source.size(); ++l) {
      EXPECT_EQ(wide.source[l], narrow.source[l] + (narrow.source[l] >= input_count));
    }
    for (std::size_t o = 0; o < output_count; ++o) {
      EXPECT_EQ(wide.output[o], narrow.output[o] + 1);
    }
    EXPECT_EQ(same.first_link, wide.first_link);
    EXPECT_EQ(same.source, wide.source);
    EXPECT_EQ(same.weight, wide.weight);
    EXPECT_EQ(same.output, wide.output);
  }
}

TEST(Compile, SlotsFollowTheShape) {
  // Links from all inputs to the first output, weights telling them apart.
  Genome genome = hand_made({}, {{0, 0, 6, 10}, {1, 5, 6, 15}, {2, -1, 6, 9}});
  genome.nodes.insert(genome.nodes.begin(), {-1, NodeKind::input});
  const ControlShape shape =
      shape_of({core::Input::neighbours, core::Input::bias, core::Input::x, core::Input::y,
                core::Input::morphogen_1, core::Input::morphogen_2, core::Input::time},
               core::paper_outputs());
  EXPECT_THAT(compile(genome, shape).source, ElementsAre(6, 1, 0));
  EXPECT_THAT(compile(genome, testing::with_neighbours()).source, ElementsAre(0, 5, 6));
}

TEST(Compile, AnOutputThatTheGenomeLacksIsZero) {
  Genome genome = hand_made({}, {{0, bias_input, 6, 1}, {1, bias_input, 12, 2}});
  std::erase_if(genome.nodes, [](const NodeGene& node) { return node.id == 8; });
  EXPECT_THAT(check(genome), IsEmpty());
  const Outputs outputs = evaluate(compile(genome), {1, 1, 1, 1, 1, 1});
  EXPECT_THAT(outputs, ElementsAre(std::tanh(0.5), 0, 0, 0, 0, 0, std::tanh(1.0)));
}

TEST(Misfits, NamesWhatItHasAndWhatWasExpected) {
  const std::string paper = "time, x, y, morphogen_1, morphogen_2, bias";
  Genome genome = hand_made({}, {});
  EXPECT_THAT(misfits(genome, {}), IsEmpty());
  EXPECT_THAT(misfits(genome, testing::with_neighbours()), IsEmpty());
  genome.nodes.insert(genome.nodes.begin(), {-1, NodeKind::input});
  EXPECT_THAT(misfits(genome, testing::with_neighbours()), IsEmpty());
  EXPECT_THAT(misfits(genome, {}),
              ElementsAre("inputs: " + paper + ", neighbours: expected none but " + paper));
  ControlShape immortal;
  std::erase(immortal.outputs, node_id(core::Output::die));
  EXPECT_THAT(misfits(hand_made({}, {}), immortal),
              ElementsAre("outputs: inhibit, angle, die, morphogen_1, morphogen_2, period, phase: "
                          "expected none but inhibit, angle, morphogen_1, morphogen_2, period, "
                          "phase"));
  EXPECT_EQ(misfits(genome, immortal).size(), 2u);
}

TEST(FreeShape, IsAShapeOfItsOwnWithTheBiasLast) {
  const ControlShape shape = free_shape(3, 2);
  ASSERT_EQ(shape.inputs.size(), 4u);
  EXPECT_EQ(shape.inputs.back(), bias_input);
  ASSERT_EQ(shape.outputs.size(), 2u);
  for (const int id : shape.inputs) EXPECT_EQ(kind_of(id), NodeKind::input);
  for (const int id : shape.outputs) EXPECT_EQ(kind_of(id), NodeKind::output);
  EXPECT_EQ(kind_of(free_shape(1, free_signals).outputs.back()), NodeKind::output);
  EXPECT_EQ(free_shape(1, free_signals).outputs.back(), least_id);
  EXPECT_EQ(kind_of(free_shape(free_signals, 1).inputs.front() - free_signals + 1),
            NodeKind::input);
  for (const int bad : {0, free_signals + 1}) {
    EXPECT_THROW(free_shape(bad, 1), std::invalid_argument);
    EXPECT_THROW(free_shape(1, bad), std::invalid_argument);
  }
}

// Without hidden nodes every input leads to every output, so that the network is their weighted
// sum.
TEST(FreeShape, SeedsWithoutHiddenNodesAreOneLayer) {
  NeatSettings settings;
  settings.hidden_nodes = 0;
  evolve::RandomStream stream = testing::test_stream(5);
  const ControlShape shape = free_shape(2, 2);
  const Genome genome = seed_genome(settings, stream, shape);
  EXPECT_THAT(check(genome), IsEmpty());
  EXPECT_THAT(misfits(genome, shape), IsEmpty());
  EXPECT_EQ(genome.links.size(), 6u);
  const core::Network network = compile(genome, shape);
  EXPECT_EQ(network.inputs, 3);
  EXPECT_EQ(network.node_count(), 2);
  for (int node = 0; node < 2; ++node) {
    std::vector<int> sources(network.source.begin() + 3 * node,
                             network.source.begin() + 3 * node + 3);
    EXPECT_THAT(sources, ::testing::UnorderedElementsAre(0, 1, 2));
  }
}

TEST(CheckGenome, AcceptsSoundGenomes) {
  EXPECT_THAT(check(hand_made({}, {})), IsEmpty());
  EXPECT_THAT(check(hand_made({13, 40}, {{3, 0, 40, 1}, {7, 40, 13, 1}, {8, 13, 6, 1}})),
              IsEmpty());
}

TEST(CheckGenome, NamesEveryFault) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto only_fault = [](const Genome& genome, const char* text) {
    EXPECT_THAT(check(genome), ElementsAre(HasSubstr(text)));
  };
  only_fault(hand_made({13}, {{0, 13, 13, 1}}), "cycle: 13 -> 13");
  only_fault(hand_made({13, 14}, {{0, 13, 14, 1}, {1, 14, 13, 1}, {2, 14, 6, 1}}), "cycle: 1");
  only_fault(hand_made({13}, {{0, 0, 13, 1}, {1, 0, 13, 1}}), "second link");
  only_fault(hand_made({}, {{1, 0, 6, 1}, {1, 0, 7, 1}}), "must ascend");
  only_fault(hand_made({13}, {{0, 13, 2, 1}}), "enters an input");
  only_fault(hand_made({13}, {{0, 6, 13, 1}}), "leaves an output");
  only_fault(hand_made({}, {{0, 0, 13, 1}}), "no node 13");
  only_fault(hand_made({}, {{0, 0, 6, nan}}), "not finite");
  only_fault(hand_made({}, {{-1, 0, 6, 1}}), "negative");
  only_fault(hand_made({14, 13}, {}), "ids must ascend");
  Genome genome = hand_made({13}, {});
  genome.nodes[13].kind = NodeKind::input;
  only_fault(genome, "node 13: kind is input");
  genome = hand_made({}, {});
  genome.nodes[0] = {-100, NodeKind::input};
  only_fault(genome,
             "node -100: input with this id is unknown: expected inputs 0-5, -1 "
             "(neighbours), outputs 6-12, free inputs -1001 to -2000, free outputs -2001 to -3000, "
             "hidden from 13 on");
  genome = hand_made({}, {});
  genome.nodes.resize(6);
  only_fault(genome, "nodes: no output among them: expected one");
}

TEST(CheckGenome, ReportsAllFaultsAtOnce) {
  const Genome genome = hand_made({13}, {{0, 13, 13, 1}, {0, 0, 6, 1}, {2, 7, 99, 1}});
  EXPECT_EQ(check(genome).size(), 4u);  // order, no node 99, leaves an output, cycle
}

TEST(CheckGenome, ACycleBehindACycleIsFoundOnce) {
  // 15 lies behind the cycle of 13 and 14; the walk back from it must end in the cycle itself.
  const std::vector<std::string> faults = check(
      hand_made({13, 14, 15}, {{0, 13, 14, 1}, {1, 14, 13, 1}, {2, 14, 15, 1}, {3, 15, 6, 1}}));
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_THAT(faults[0], ::testing::Not(HasSubstr("15")));
}

TEST(CheckGenome, SurvivesAnything) {
  EXPECT_EQ(check(Genome{}).size(), 2u);  // no input, no output
  evolve::RandomStream stream = test_stream(3);
  for (int i = 0; i < 2000; ++i) {
    Genome genome;
    const auto any = [&] { return static_cast<int>(stream.below(20)) - 2; };
    for (std::uint32_t n = stream.below(20); n > 0; --n) {
      genome.nodes.push_back({any(), static_cast<NodeKind>(stream.below(3))});
    }
    for (std::uint32_t l = stream.below(20); l > 0; --l)
      genome.links.push_back({any(), any(), any(), 1});
    const auto faults = check(genome);
    for (const std::string& fault : faults) ASSERT_FALSE(fault.empty());
    if (faults.empty()) compile(genome, testing::with_neighbours());
  }
}

}  // namespace
}  // namespace metamorph::evolve
