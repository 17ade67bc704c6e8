#pragma once

#include <array>
#include <vector>

namespace metamorph::core {

inline constexpr int network_inputs = 6;   ///< time, x, y, morphogen 1, morphogen 2, bias
inline constexpr int network_outputs = 7;  ///< inhibit, angle, die, morphogen 1, 2, period, phase

/// A feed-forward control network, flattened for inference. Values live in slots: 0-5 are the
/// inputs, then one slot per computed node in topological order. Node n (slot 6 + n) is
/// tanh(s/2) of s = sum of weight[l] * value[source[l]] for l in [first_link[n], first_link[n+1]),
/// summed in that order. A node without links is 0.
struct Network {
  std::vector<int> first_link = {0};          ///< [nodes + 1]
  std::vector<int> source;                    ///< [links] slot the link comes from
  std::vector<float> weight;                  ///< [links]
  std::array<int, network_outputs> output{};  ///< slot of each output

  int node_count() const { return static_cast<int>(first_link.size()) - 1; }
};

}  // namespace metamorph::core
