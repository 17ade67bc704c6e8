#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/development/colony.h"
#include "core/development/neighbourhood.h"
#include "kernels/elementary.h"
#include "kernels/network_inference.h"
#include "metamorph/development.h"
#include "metamorph/network.h"
#include "metamorph/signals.h"

namespace metamorph::core {

/// What a control network says to each cell: reads the inputs (MODEL section 2, Control network)
/// and evaluates all cells side by side.
template <class T>
class Control {
 public:
  /// Borrows the rules.
  explicit Control(const DevelopmentRules& rules) : rules_(rules) {}

  /// Borrows the network until the next call.
  void set_network(const Network& network) {
    network_ = &network;
    slots_ = network.inputs + network.node_count();
    output_slot_.fill(-1);
    for (std::size_t o = 0; o < rules_.outputs.size(); ++o) {
      output_slot_[static_cast<std::size_t>(rules_.outputs[o])] = network.output[o];
    }
  }

  void evaluate(int step, const Colony<T>& colony, const Neighbourhood& neighbourhood) {
    value_.assign(static_cast<std::size_t>(kernels::network_value_size(slots_, colony.count)),
                  T(0));
    average(colony, neighbourhood);
    for (std::size_t slot = 0; slot < rules_.inputs.size(); ++slot) {
      read_input(rules_.inputs[slot], static_cast<int>(slot), step, colony);
    }
    const kernels::NetworkView view = {network_->inputs, network_->node_count(),
                                       network_->first_link.data(), network_->source.data(),
                                       network_->weight.data()};
    kernels::infer_network(view, colony.count, value_.data());
  }

  /// An output of the last evaluation; 0 if the network has none of that name.
  T operator()(Output output, int cell) const {
    const int slot = output_slot_[static_cast<std::size_t>(output)];
    if (slot < 0) return T(0);
    return value_[static_cast<std::size_t>(kernels::network_value_index(slots_, slot, cell))];
  }

 private:
  /// What a cell's neighbours are, in the mean.
  struct Surroundings {
    T morphogen1, morphogen2;
    int neighbours;
  };

  void average(const Colony<T>& colony, const Neighbourhood& neighbourhood) {
    around_.resize(static_cast<std::size_t>(colony.count));
    for (int i = 0; i < colony.count; ++i) {
      T first = 0, second = 0;
      for (const int j : neighbourhood.of(i)) {
        first += colony.morphogen1[static_cast<std::size_t>(j)];
        second += colony.morphogen2[static_cast<std::size_t>(j)];
      }
      const int neighbours = neighbourhood.of(i).size();
      const T divisor = neighbours > 0 ? static_cast<T>(neighbours) : T(1);
      around_[static_cast<std::size_t>(i)] = {first / divisor, second / divisor, neighbours};
    }
  }

  /// Fills the slot of one input, for all cells.
  void read_input(Input input, int slot, int step, const Colony<T>& colony) {
    const auto fill = [&](const auto& read) {
      for (int i = 0; i < colony.count; ++i) {
        const int at = kernels::network_value_index(slots_, slot, i);
        value_[static_cast<std::size_t>(at)] = read(static_cast<std::size_t>(i));
      }
    };
    const T time = static_cast<T>(static_cast<double>(step) / rules_.steps);
    const T scale = static_cast<T>(rules_.coordinate_scale);
    switch (input) {  // without a default, so that a new input does not compile without its value
      case Input::time:
        return fill([&](std::size_t) { return time; });
      case Input::x:
        return fill([&](std::size_t i) { return colony.cell[i].x / scale; });
      case Input::y:
        return fill([&](std::size_t i) { return colony.cell[i].y / scale; });
      case Input::morphogen_1:
        return fill([&](std::size_t i) { return around_[i].morphogen1; });
      case Input::morphogen_2:
        return fill([&](std::size_t i) { return around_[i].morphogen2; });
      case Input::bias:
        return fill([&](std::size_t) { return T(1); });
      case Input::neighbours:
        return fill([&](std::size_t i) { return static_cast<T>(around_[i].neighbours) / T(6); });
    }
  }

  const DevelopmentRules& rules_;
  const Network* network_ = nullptr;
  int slots_ = 0;
  std::array<int, output_signals.size()> output_slot_{};  // [Output], -1: not there
  std::vector<T> value_;
  std::vector<Surroundings> around_;
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
