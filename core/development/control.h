#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "core/development/colony.h"
#include "core/development/neighbourhood.h"
#include "kernels/elementary.h"
#include "kernels/network_inference.h"
#include "metamorph/development.h"
#include "metamorph/network.h"

namespace metamorph::core {

/// What a control network says to each cell: reads the inputs (MODEL section 2, Control network)
/// and evaluates all cells side by side.
template <class T>
class Control {
 public:
  enum Output { inhibit, angle, die, morphogen1, morphogen2, period, phase };

  /// Borrows the network until the next call.
  void set_network(const Network& network) {
    network_ = &network;
    slots_ = network_inputs + network.node_count();
  }

  void evaluate(const DevelopmentRules& rules, int step, const Colony<T>& colony,
                const Neighbourhood& neighbourhood) {
    value_.assign(static_cast<std::size_t>(kernels::network_value_size(slots_, colony.count)),
                  T(0));
    const T time = static_cast<T>(static_cast<double>(step) / rules.steps);
    const T scale = static_cast<T>(rules.coordinate_scale);
    for (int i = 0; i < colony.count; ++i) {
      T first = 0, second = 0;
      for (const int j : neighbourhood.of(i)) {
        first += colony.morphogen1[static_cast<std::size_t>(j)];
        second += colony.morphogen2[static_cast<std::size_t>(j)];
      }
      const auto neighbours = neighbourhood.of(i).size();
      const T divisor = neighbours > 0 ? static_cast<T>(neighbours) : T(1);
      const auto& cell = colony.cell[static_cast<std::size_t>(i)];
      value(0, i) = time;
      value(1, i) = cell.x / scale;
      value(2, i) = cell.y / scale;
      value(3, i) = first / divisor;
      value(4, i) = second / divisor;
      value(5, i) = T(1);
    }
    const kernels::NetworkView view = {network_inputs, network_->node_count(),
                                       network_->first_link.data(), network_->source.data(),
                                       network_->weight.data()};
    kernels::infer_network(view, colony.count, value_.data());
  }

  /// An output of the last evaluation.
  T operator()(Output output, int cell) const {
    const int slot = network_->output[static_cast<std::size_t>(output)];
    return value_[static_cast<std::size_t>(kernels::network_value_index(slots_, slot, cell))];
  }

 private:
  T& value(int slot, int cell) {
    return value_[static_cast<std::size_t>(kernels::network_value_index(slots_, slot, cell))];
  }

  const Network* network_ = nullptr;
  int slots_ = 0;
  std::vector<T> value_;
};

/// The direction in which a cell looks next (MODEL section 2, One update (1)): the mean orientation
/// of its neighbours, or its own where there is none, turned by pi * turn.
template <class T>
inline void turned_heading(const Colony<T>& colony, const Neighbourhood& neighbourhood, int cell,
                           T turn, T& heading_x, T& heading_y) {
  T x = 0, y = 0;
  for (const int j : neighbourhood.of(cell)) {
    x += colony.heading_x[static_cast<std::size_t>(j)];
    y += colony.heading_y[static_cast<std::size_t>(j)];
  }
  T length = std::sqrt(x * x + y * y);
  if (length < T(1e-9)) {
    x = colony.heading_x[static_cast<std::size_t>(cell)];
    y = colony.heading_y[static_cast<std::size_t>(cell)];
    length = std::sqrt(x * x + y * y);
  }
  T sine, cosine;
  kernels::sin_cos_pi(turn, sine, cosine);
  heading_x = (cosine * x - sine * y) / length;
  heading_y = (sine * x + cosine * y) / length;
}

}  // namespace metamorph::core
