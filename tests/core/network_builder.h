#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "metamorph/network.h"
#include "metamorph/random.h"

namespace metamorph::core::testing {

inline constexpr int network_inputs = 6;
inline constexpr int network_outputs = 7;

/// Slots of the inputs and positions of the outputs, by name.
enum Input { time, x, y, mean1, mean2, bias };
enum Output { inhibit, angle, die, morphogen1, morphogen2, period, phase };

/// Writes a network by hand: one node per output, each a weighted sum of inputs.
class NetworkBuilder {
 public:
  NetworkBuilder& link(Output output, Input input, float weight) {
    links_[output].push_back({input, weight});
    return *this;
  }

  /// Output says +-1 to the last bit (tanh(+-32)), always.
  NetworkBuilder& always(Output output, bool positive) {
    return link(output, bias, positive ? 64.0f : -64.0f);
  }

  /// Output is negative before the given share of development, 0 at it, positive after it. The
  /// share should be a multiple of a power of two, for exact sums.
  NetworkBuilder& positive_after(Output output, float share) {
    return link(output, time, 64.0f).link(output, bias, -64.0f * share);
  }

  NetworkBuilder& negative_after(Output output, float share) {
    return link(output, time, -64.0f).link(output, bias, 64.0f * share);
  }

  Network build() const {
    Network network;
    network.inputs = network_inputs;
    for (int o = 0; o < network_outputs; ++o) {
      for (const auto& [source, weight] : links_[static_cast<std::size_t>(o)]) {
        network.source.push_back(source);
        network.weight.push_back(weight);
      }
      network.first_link.push_back(static_cast<int>(network.source.size()));
      network.output.push_back(network_inputs + o);
    }
    return network;
  }

 private:
  std::array<std::vector<std::pair<int, float>>, network_outputs> links_;
};

/// The topology of a seed genome (MODEL section 5): inputs to 8 hidden nodes, those to the outputs,
/// bias to the outputs; weights 2 * (difference of two uniforms).
inline Network random_network(std::uint64_t seed, std::uint32_t individual = 0) {
  constexpr int hidden = 8;
  evolve::RandomStream random(evolve::Purpose::test, seed, 0, individual);
  Network network;
  network.inputs = network_inputs;
  const auto add = [&](int source) {
    network.source.push_back(source);
    network.weight.push_back(static_cast<float>(2 * random.triangular()));
  };
  const auto end_node = [&] {
    network.first_link.push_back(static_cast<int>(network.source.size()));
  };
  for (int h = 0; h < hidden; ++h) {
    for (int i = 0; i < network_inputs; ++i) add(i);
    end_node();
  }
  for (int o = 0; o < network_outputs; ++o) {
    for (int h = 0; h < hidden; ++h) add(network_inputs + h);
    add(bias);
    end_node();
    network.output.push_back(network_inputs + hidden + o);
  }
  return network;
}

}  // namespace metamorph::core::testing
