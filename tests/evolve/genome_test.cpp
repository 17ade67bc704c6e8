#include "evolve/genetics/genome.h"

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

using Inputs = std::array<double, core::network_inputs>;
using Outputs = std::array<double, core::network_outputs>;

// What a genome means, straight from its genes: a node is the sigmoid of what its links bring.
Outputs evaluate_recursively(const Genome& genome, const Inputs& inputs) {
  const std::function<double(int)> value = [&](int node) -> double {
    if (node < core::network_inputs) return inputs[static_cast<std::size_t>(node)];
    double sum = 0;
    for (const LinkGene& link : genome.links) {
      if (link.to == node)
        sum += static_cast<double>(static_cast<float>(link.weight)) * value(link.from);
    }
    return std::tanh(sum / 2);
  };
  Outputs outputs;
  for (int o = 0; o < core::network_outputs; ++o) {
    outputs[static_cast<std::size_t>(o)] = value(core::network_inputs + o);
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
      EXPECT_LT(network.source[link], core::network_inputs + n);
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
  EXPECT_EQ(compile(genome).node_count(), core::network_outputs + 1);
}

TEST(Compile, AnUnlinkedHiddenNodeIsZero) {
  const Genome genome = hand_made({13}, {{0, 13, 6, 5}, {1, bias_input, 6, 1}});
  EXPECT_EQ(evaluate(compile(genome), {0, 0, 0, 0, 0, 1})[0], std::tanh(0.5));
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
  genome.nodes.erase(genome.nodes.begin() + 6);
  only_fault(genome, "node 6: this output is missing");
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
  EXPECT_EQ(check(Genome{}).size(), static_cast<std::size_t>(first_hidden));
  evolve::RandomStream stream = test_stream(3);
  for (int i = 0; i < 2000; ++i) {
    Genome genome;
    const auto any = [&] { return static_cast<int>(stream.below(20)) - 2; };
    for (std::uint32_t n = stream.below(20); n > 0; --n) {
      genome.nodes.push_back({any(), static_cast<NodeKind>(stream.below(3))});
    }
    for (std::uint32_t l = stream.below(20); l > 0; --l)
      genome.links.push_back({any(), any(), any(), 1});
    ASSERT_THAT(check(genome), ::testing::Not(IsEmpty()));  // never 13 nodes in order by chance
  }
}

}  // namespace
}  // namespace metamorph::evolve
