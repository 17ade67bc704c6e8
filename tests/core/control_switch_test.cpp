#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/development/link_check.h"
#include "tests/core/random_developments.h"

namespace metamorph::core {
namespace {

using testing::NetworkBuilder;
using testing::population;
using testing::same;
using In = testing::Input;
using Out = testing::Output;

using Life = std::vector<Network>;

std::vector<Embryo> grow(const Life& life, const std::vector<int>& switches,
                         const std::vector<int>& stages, const DevelopmentRules& rules = {}) {
  return develop({&life, 1}, switches, rules, stages, 1).front();
}

TEST(ControlSwitch, EqualNetworksAreOneToTheBit) {
  const std::vector<int> stages = {400, 600, 601, 800, 1200};
  for (const Network& network : population(21, 20)) {
    const auto alone = develop({&network, 1}, {}, stages, 1).front();
    EXPECT_TRUE(same(grow({network}, {600}, stages), alone));
    EXPECT_TRUE(same(grow({network, network}, {600}, stages), alone));
    EXPECT_TRUE(same(grow({network, network, network}, {400, 815}, stages), alone));
  }
}

// Up to the step of the switch, its own embryo included, all is the first network's.
TEST(ControlSwitch, ChangesNothingBeforeIt) {
  const auto first = population(22, 30), second = population(23, 30);
  const std::vector<int> before = {30, 300, 599, 600}, after = {900};
  int parted = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const auto alone = develop({&first[i], 1}, {}, before, 1).front();
    EXPECT_TRUE(same(grow({first[i], second[i]}, {600}, before), alone));
    const auto gone_on = develop({&first[i], 1}, {}, after, 1).front();
    parted += !same(grow({first[i], second[i]}, {600}, after), gone_on);
  }
  EXPECT_GT(parted, 5);
}

/// Grows a bent line: turns by the same angle in every update; the phase is told to be `phase`.
NetworkBuilder turning(float turn, float phase) {
  return NetworkBuilder()
      .always(Out::inhibit, false)
      .link(Out::angle, In::bias, turn)
      .link(Out::phase, In::bias, phase);
}

/// A network of the same kind whose turn and phase are those of `a` before the update at half of
/// development, and those of `b` from it on: a node says -1 or 1, to the last bit, and the sums of
/// the outputs are sums of multiples of 1/8.
Network clocked(float turn_a, float turn_b, float phase_a, float phase_b) {
  Network network;
  network.inputs = testing::network_inputs;
  const auto node = [&](const std::vector<std::pair<int, float>>& links) {
    for (const auto& [source, weight] : links) {
      network.source.push_back(source);
      network.weight.push_back(weight);
    }
    network.first_link.push_back(static_cast<int>(network.source.size()));
  };
  // Between the updates at 570 and 600 of 1200 steps.
  const float half = 0.5f - 1.0f / 256;
  node({{In::time, 16384}, {In::bias, -16384 * half}});
  const int clock = testing::network_inputs;
  for (int o = 0; o < testing::network_outputs; ++o) {
    const auto halves = [&](float a, float b) {
      node({{In::bias, (a + b) / 2}, {clock, (b - a) / 2}});
    };
    if (o == Out::angle) {
      halves(turn_a, turn_b);
    } else if (o == Out::phase) {
      halves(phase_a, phase_b);
    } else if (o == Out::inhibit) {
      node({{In::bias, -64}});
    } else {
      node({});
    }
    network.output.push_back(clock + 1 + o);
  }
  return network;
}

TEST(ControlSwitch, EqualsANetworkThatReadsTheTime) {
  const Network a = turning(0.25f, 1).build(), b = turning(-0.5f, -2).build();
  const Network both = clocked(0.25f, -0.5f, 1, -2);
  const std::vector<int> stages = {300, 575, 601, 900, 1200};
  const auto by_time = develop({&both, 1}, {}, stages, 1).front();
  const auto by_switch = grow({a, b}, {600}, stages);
  EXPECT_TRUE(same(by_switch, by_time));
  EXPECT_GT(by_time.back().cell_count(), 10);
  const auto of_first = develop({&a, 1}, {}, stages, 1).front();
  EXPECT_FALSE(same(of_first[3], by_time[3]));
}

// Between two updates the later network controls from its step on, and no sooner: its first update
// is the next one, but an embryo taken out there already has its oscillators.
TEST(ControlSwitch, LiesBetweenUpdatesAsWell) {
  const Network a = turning(0.25f, 1).build(), b = turning(-0.5f, -2).build();
  const std::vector<int> stages = {610, 615, 630};
  const auto alone = develop({&a, 1}, {}, stages, 1).front();
  const auto switched = grow({a, b}, {610}, stages);
  EXPECT_TRUE(same(switched[0], alone[0]));
  EXPECT_EQ(switched[2].x, alone[2].x);
  for (const std::size_t later : {1u, 2u}) {
    EXPECT_EQ(switched[later].orientation, alone[later].orientation);
    for (const double phase : switched[later].phase) EXPECT_LT(phase, 0);
    for (const double phase : alone[later].phase) EXPECT_GT(phase, 0);
  }
}

TEST(ControlSwitch, SeveralAtOneStepLeaveTheLast) {
  const auto networks = population(24, 3);
  const std::vector<int> stages = {600, 1200};
  EXPECT_TRUE(same(grow({networks[0], networks[1], networks[2]}, {600, 600}, stages),
                   grow({networks[0], networks[2]}, {600}, stages)));
}

TEST(ControlSwitch, BatchOrderAndThreadsDoNotChangeABit) {
  const auto first = population(25, 16), second = population(26, 16);
  std::vector<Life> lives;
  for (std::size_t i = 0; i < first.size(); ++i) {
    lives.push_back(i % 3 == 0 ? Life{first[i]} : Life{first[i], second[i]});
  }
  const std::vector<int> switches = {450}, stages = {450, 900};
  const auto batch = develop(lives, switches, {}, stages, 1);
  const auto threaded = develop(lives, switches, {}, stages, 2);
  for (std::size_t i = 0; i < lives.size(); ++i) {
    EXPECT_TRUE(same(batch[i], threaded[i]));
    EXPECT_TRUE(same(batch[i], grow(lives[i], switches, stages)));
  }
  for (const LinkCheck& check : check_links(lives, switches, {}, stages, 1)) {
    EXPECT_TRUE(check.ok()) << difference_text(check);
  }
}

}  // namespace
}  // namespace metamorph::core
