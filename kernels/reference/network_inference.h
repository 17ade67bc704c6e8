#pragma once

#include <cmath>

namespace metamorph::kernels::reference {

/// One cell through a flattened network (see kernels/network_inference.h for the format).
/// value: [inputs + nodes], inputs filled.
inline void infer_network(int inputs, int nodes, const int* first_link, const int* source,
                          const float* weight, double* value) {
  for (int n = 0; n < nodes; ++n) {
    double sum = 0;
    for (int l = first_link[n]; l < first_link[n + 1]; ++l) sum += weight[l] * value[source[l]];
    value[inputs + n] = std::tanh(sum / 2);
  }
}

}  // namespace metamorph::kernels::reference
