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
      // Four links at a time, so that the sum is fetched and stored less often; in the same order.
      int l = network.first_link[n];
      const int end = network.first_link[n + 1];
      const auto weight = [&](int link) { return static_cast<T>(network.weight[link]); };
      const auto from = [&](int link) { return block + network.source[link] * inference_lanes; };
      for (; l + 4 <= end; l += 4) {
        const T w0 = weight(l), w1 = weight(l + 1), w2 = weight(l + 2), w3 = weight(l + 3);
        const T *const v0 = from(l), *const v1 = from(l + 1), *const v2 = from(l + 2),
                       *const v3 = from(l + 3);
#pragma omp simd
        for (int lane = 0; lane < inference_lanes; ++lane) {
          T s = sum[lane];
          s = std::fma(w0, v0[lane], s);
          s = std::fma(w1, v1[lane], s);
          s = std::fma(w2, v2[lane], s);
          sum[lane] = std::fma(w3, v3[lane], s);
        }
      }
      for (; l < end; ++l) {
        const T w = weight(l);
        const T* const v = from(l);
#pragma omp simd
        for (int lane = 0; lane < inference_lanes; ++lane)
          sum[lane] = std::fma(w, v[lane], sum[lane]);
      }
      T* const to = block + (network.inputs + n) * inference_lanes;
#pragma omp simd
      for (int lane = 0; lane < inference_lanes; ++lane) to[lane] = tanh_half(sum[lane]);
    }
  }
}

}  // namespace metamorph::kernels
