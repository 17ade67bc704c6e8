// Inputs and outputs of control networks as the rules of development name them.

#include "metamorph/signals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "metamorph/development.h"
#include "tests/core/network_builder.h"

namespace metamorph::core {
namespace {

using testing::NetworkBuilder;
using testing::random_network;
using Out = testing::Output;

constexpr int neighbours_slot = 6;  // behind the six inputs of the paper

DevelopmentRules with_neighbours() {
  DevelopmentRules rules;
  rules.inputs.push_back(Input::neighbours);
  return rules;
}

DevelopmentRules without(Output output) {
  DevelopmentRules rules;
  std::erase(rules.outputs, output);
  return rules;
}

/// The same network for rules with one more input, from which no link comes.
Network widened(Network network) {
  for (int& source : network.source) source += source >= network.inputs;
  for (int& slot : network.output) ++slot;
  ++network.inputs;
  return network;
}

/// The same network without one of its outputs: the node stays, nobody reads it.
Network without(Network network, Output output) {
  network.output.erase(network.output.begin() + static_cast<int>(output));
  return network;
}

Embryo grow(const Network& network, const DevelopmentRules& rules, int stage = 1200) {
  return develop(std::vector{network}, rules, std::vector{stage}, 1).front().front();
}

void expect_same(const Embryo& a, const Embryo& b) {
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.mother, b.mother);
  EXPECT_EQ(a.x, b.x);
  EXPECT_EQ(a.y, b.y);
  EXPECT_EQ(a.orientation, b.orientation);
  EXPECT_EQ(a.period, b.period);
  EXPECT_EQ(a.phase, b.phase);
  EXPECT_EQ(a.links, b.links);
  EXPECT_EQ(a.created, b.created);
  EXPECT_EQ(a.died, b.died);
}

TEST(Signals, DefaultRulesHaveThoseOfThePaper) {
  const DevelopmentRules rules;
  EXPECT_EQ(rules.inputs, (std::vector{Input::time, Input::x, Input::y, Input::morphogen_1,
                                       Input::morphogen_2, Input::bias}));
  EXPECT_EQ(rules.outputs.size(), 7u);
}

TEST(Signals, AnInputThatNobodyReadsChangesNoBit) {
  for (std::uint32_t i = 0; i < 20; ++i) {
    const Network network = random_network(11, i);
    expect_same(grow(network, {}), grow(widened(network), with_neighbours()));
  }
}

TEST(Signals, NeighboursCountsLinkedCellsInSixths) {
  // A line of three cells: at step 60 it had two updates. The phase of each is its count.
  Network network = widened(NetworkBuilder().always(Out::inhibit, false).build());
  const auto link = static_cast<std::size_t>(network.first_link[Out::phase]);
  ASSERT_EQ(link, network.source.size());  // the phase is the last node, and has no link yet
  network.source.push_back(neighbours_slot);
  network.weight.push_back(1.0f);
  network.first_link.back() = static_cast<int>(network.source.size());
  const Embryo embryo = grow(network, with_neighbours(), 60);
  ASSERT_EQ(embryo.cell_count(), 3);
  const double counts[] = {1, 2, 1};
  for (std::size_t i = 0; i < 3; ++i) {
    // Float: errors of n / 6, of tanh and of its place, each some 1e-7.
    EXPECT_NEAR(embryo.phase[i], std::numbers::pi * std::tanh(counts[i] / 6 / 2),
                std::numbers::pi * 3e-7);
  }
  EXPECT_EQ(grow(network, with_neighbours(), 0).phase[0], 0);  // a cell alone
}

TEST(Signals, AnOutputThatIsLeftOutReadsZero) {
  for (const auto& [output, name, meaning] : output_signals) {
    for (std::uint32_t i = 0; i < 5; ++i) {
      const Network network = random_network(12, i);
      // Behind the nodes that are there, one without links: 0.
      Network zero = network;
      zero.first_link.push_back(zero.first_link.back());
      zero.output[static_cast<std::size_t>(output)] = zero.inputs + zero.node_count() - 1;
      SCOPED_TRACE(name);
      expect_same(grow(without(network, output), without(output)), grow(zero, {}));
    }
  }
}

TEST(Signals, WithoutDieNoCellEverDies) {
  int dead = 0;
  for (std::uint32_t i = 0; i < 20; ++i) {
    const Network network = random_network(13, i);
    dead += grow(network, {}).died;
    EXPECT_EQ(grow(without(network, Output::die), without(Output::die)).died, 0);
  }
  EXPECT_GT(dead, 0);  // with it some do
}

TEST(Signals, InputsMayStandInAnyOrder) {
  const Network network = random_network(14);
  DevelopmentRules reversed;
  std::reverse(reversed.inputs.begin(), reversed.inputs.end());
  Network other = network;
  for (int& source : other.source) {
    if (source < other.inputs) source = other.inputs - 1 - source;
  }
  expect_same(grow(network, {}), grow(other, reversed));
}

TEST(CheckNetwork, AcceptsWhatFits) {
  EXPECT_EQ(check(random_network(1), {}), "");
  EXPECT_EQ(check(widened(random_network(1)), with_neighbours()), "");
  EXPECT_EQ(check(without(random_network(1), Output::die), without(Output::die)), "");
}

TEST(CheckNetwork, SaysInALineWhatDoesNot) {
  const auto fault = [](auto change) {
    Network network = random_network(1);
    change(network);
    return check(network, {});
  };
  EXPECT_EQ(check(widened(random_network(1)), {}),
            "inputs: 7: expected 6 (time, x, y, morphogen_1, morphogen_2, bias)");
  EXPECT_EQ(check(random_network(1), without(Output::die)),
            "output: 7 slots: expected 6 (inhibit, angle, morphogen_1, morphogen_2, period, "
            "phase)");
  EXPECT_EQ(fault([](Network& n) { n.first_link[0] = 1; }),
            "first_link: expected to go from 0 to the number of links, 111");
  EXPECT_EQ(fault([](Network& n) { n.first_link.clear(); }),
            "first_link: expected to go from 0 to the number of links, 111");
  EXPECT_EQ(fault([](Network& n) { n.first_link[2] = 5; }),
            "first_link[2]: 5: expected from 6 to 111");
  EXPECT_EQ(fault([](Network& n) { n.weight.pop_back(); }),
            "weight: 110 values: expected one for each of 111 links");
  EXPECT_EQ(fault([](Network& n) { n.source[7] = 7; }),
            "source[7]: 7: expected an input or an earlier node of node 1, below 7");
  EXPECT_EQ(fault([](Network& n) { n.source[0] = -1; }),
            "source[0]: -1: expected an input or an earlier node of node 0, below 6");
  EXPECT_EQ(fault([](Network& n) { n.output[6] = 21; }), "output[6]: 21: expected a slot below 21");
  EXPECT_EQ(fault([](Network& n) { n.output[0] = -1; }), "output[0]: -1: expected a slot below 21");
}

}  // namespace
}  // namespace metamorph::core
