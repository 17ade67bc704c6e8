#pragma once

#include <vector>

namespace metamorph::core {

/// A feed-forward control network, flattened for inference. Values live in slots: the first
/// `inputs` are the inputs, then one slot per computed node in topological order. Node n (slot
/// inputs + n) is tanh(s/2) of s = sum of weight[l] * value[source[l]] for l in [first_link[n],
/// first_link[n+1]), summed in that order. A node without links is 0. Which inputs and outputs
/// these are is said by the rules of development (DevelopmentRules::inputs, outputs), in the same
/// order.
struct Network {
  int inputs = 0;
  std::vector<int> first_link = {0};  ///< [nodes + 1]
  std::vector<int> source;            ///< [links] slot the link comes from
  std::vector<float> weight;          ///< [links]
  std::vector<int> output;            ///< [outputs] slot of each output

  int node_count() const { return static_cast<int>(first_link.size()) - 1; }
};

}  // namespace metamorph::core
