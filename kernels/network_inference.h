#pragma once

#include <cmath>

#include "kernels/elementary.h"

namespace metamorph::kernels {

/// A flattened feed-forward network: slots 0 .. inputs-1 are the inputs, then one slot per node.
/// Node n has the links [first_link[n], first_link[n + 1]); it is tanh(s/2) of their weighted sum
/// s, summed in that order, and 0 without links.
struct NetworkView {
  int inputs;
  int nodes;
  const int* first_link;  ///< [nodes + 1]
  const int* source;      ///< [links] slot
  const float* weight;    ///< [links]
};

/// Cells evaluated side by side: enough to hide the latency of the sums.
inline constexpr int inference_lanes = 32;

/// Where a slot's value of a cell lies: blocks of inference_lanes cells, slots within a block.
inline int network_value_index(int slots, int slot, int cell) {
  return ((cell / inference_lanes) * slots + slot) * inference_lanes + cell % inference_lanes;
}

/// Elements that the value array of `cells` cells needs.
inline int network_value_size(int slots, int cells) {
  return (cells + inference_lanes - 1) / inference_lanes * inference_lanes * slots;
}

/// Computes all node slots of cells 0 .. cells-1 from their input slots. value:
/// [network_value_size], every input slot of the last block finite or at least initialised.
template <class T>
inline void infer_network(const NetworkView& network, int cells, T* value) {
  const int slots = network.inputs + network.nodes;
  for (int start = 0; start < cells; start += inference_lanes) {
    T* const block = value + network_value_index(slots, 0, start);
    for (int n = 0; n < network.nodes; ++n) {
      T sum[inference_lanes] = {};
      for (int l = network.first_link[n]; l < network.first_link[n + 1]; ++l) {
        const T weight = static_cast<T>(network.weight[l]);
        const T* const from = block + network.source[l] * inference_lanes;
#pragma omp simd
        for (int lane = 0; lane < inference_lanes; ++lane)
          sum[lane] = std::fma(weight, from[lane], sum[lane]);
      }
      T* const to = block + (network.inputs + n) * inference_lanes;
#pragma omp simd
      for (int lane = 0; lane < inference_lanes; ++lane) to[lane] = tanh_half(sum[lane]);
    }
  }
}

}  // namespace metamorph::kernels
