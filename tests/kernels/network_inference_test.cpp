#include "kernels/network_inference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "kernels/reference/network_inference.h"
#include "tests/core/network_builder.h"

namespace metamorph::kernels {
namespace {

using core::Network;

constexpr int network_inputs = 6;

NetworkView view_of(const Network& network) {
  return {network_inputs, network.node_count(), network.first_link.data(), network.source.data(),
          network.weight.data()};
}

double input(int slot, int cell) { return std::sin(1.0 + 3 * slot + 7 * cell); }

/// All slots of all cells, [cell][slot].
template <class T>
std::vector<std::vector<T>> evaluated(const Network& network, int first_cell, int cells) {
  const int slots = network_inputs + network.node_count();
  std::vector<T> value(static_cast<std::size_t>(network_value_size(slots, cells)));
  const auto at = [&](int slot, int cell) {
    return static_cast<std::size_t>(network_value_index(slots, slot, cell));
  };
  for (int c = 0; c < cells; ++c) {
    for (int s = 0; s < network_inputs; ++s) {
      value[at(s, c)] = static_cast<T>(input(s, first_cell + c));
    }
  }
  infer_network(view_of(network), cells, value.data());
  std::vector<std::vector<T>> result(static_cast<std::size_t>(cells));
  for (int c = 0; c < cells; ++c) {
    for (int s = 0; s < slots; ++s) result[static_cast<std::size_t>(c)].push_back(value[at(s, c)]);
  }
  return result;
}

template <class T>
void expect_close_to_reference(double tolerance) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Network network = core::testing::random_network(seed);
    const int nodes = network.node_count();
    const auto fast = evaluated<T>(network, 0, 40);
    for (std::size_t c = 0; c < fast.size(); ++c) {
      std::vector<double> value(static_cast<std::size_t>(network_inputs + nodes));
      for (int s = 0; s < network_inputs; ++s) {
        value[static_cast<std::size_t>(s)] =
            static_cast<double>(static_cast<T>(input(s, static_cast<int>(c))));
      }
      reference::infer_network(network_inputs, nodes, network.first_link.data(),
                               network.source.data(), network.weight.data(), value.data());
      for (std::size_t s = 0; s < value.size(); ++s) {
        ASSERT_NEAR(static_cast<double>(fast[c][s]), value[s], tolerance);
      }
    }
  }
}

// Sums of at most 9 terms of |weight * value| <= 2: rounding 9 * 18 / 2 units of 2^-24 (2^-53), a
// node's slope is 1/2, and a second layer with weights summing to 16 carries the first one's error
// times 8. With the activation's own error about 2e-5 in float, 4e-14 in double.
TEST(NetworkInference, AgreesWithTheReference) {
  expect_close_to_reference<float>(5e-5);
  expect_close_to_reference<double>(1e-13);
}

TEST(NetworkInference, ACellsBitsDoNotDependOnItsLaneOrItsCompany) {
  const Network network = core::testing::random_network(5);
  const auto all = evaluated<float>(network, 0, 100);
  for (const int cell : {0, 1, 31, 32, 99}) {
    EXPECT_EQ(evaluated<float>(network, cell, 1).front(), all[static_cast<std::size_t>(cell)]);
  }
  const auto part = evaluated<float>(network, 40, 33);
  for (std::size_t c = 0; c < part.size(); ++c) EXPECT_EQ(part[c], all[40 + c]);
}

TEST(NetworkInference, ANodeWithoutLinksIsZeroAndNodesMayFeedNodes) {
  Network network;
  network.first_link = {0, 0, 1, 3};
  network.source = {0, network_inputs, network_inputs + 1};
  network.weight = {64.0f, 5.0f, -64.0f};
  for (const auto& slots : evaluated<float>(network, 0, 3)) {
    EXPECT_EQ(slots[network_inputs], 0.0f);
    EXPECT_EQ(slots[network_inputs + 2], tanh_half(-64.0f * slots[network_inputs + 1]));
  }
}

}  // namespace
}  // namespace metamorph::kernels
