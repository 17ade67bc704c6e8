#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "metamorph/development.h"
#include "metamorph/signals.h"

namespace metamorph::evolve {

/// The node that stands for a signal in every genome, for ever: genomes of different experiments
/// and versions speak of the same nodes. The paper's have 0 to 12; whatever came later counts
/// downwards from -1, since hidden nodes start at 13.
inline constexpr std::array<int, core::input_signals.size()> input_ids = {0, 1, 2, 3, 4, 5, -1};
inline constexpr std::array<int, core::output_signals.size()> output_ids = {6, 7, 8, 9, 10, 11, 12};
inline constexpr int first_hidden = 13;
/// Free inputs and outputs, for problems that are no control of cells: number i has first - i.
inline constexpr int free_signals = 1000;  ///< of each at most
inline constexpr int first_free_input = -1001, first_free_output = first_free_input - free_signals;
inline constexpr int least_id = first_free_output - free_signals + 1;

constexpr int node_id(core::Input input) { return input_ids[static_cast<std::size_t>(input)]; }
constexpr int node_id(core::Output output) { return output_ids[static_cast<std::size_t>(output)]; }

inline constexpr int bias_input = node_id(core::Input::bias);

namespace detail {
/// Whether every signal has an id of its own, below those of hidden nodes.
constexpr bool signal_ids_differ() {
  std::array<int, input_ids.size() + output_ids.size()> ids{};
  std::size_t count = 0;
  for (const int id : input_ids) ids[count++] = id;
  for (const int id : output_ids) ids[count++] = id;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (ids[i] >= first_hidden || ids[i] <= first_free_input) return false;
    for (std::size_t j = 0; j < i; ++j) {
      if (ids[i] == ids[j]) return false;
    }
  }
  return true;
}
}  // namespace detail
static_assert(detail::signal_ids_differ());

/// Which inputs and outputs the networks of a population have, as nodes of genomes. Slots of a
/// network follow these lists. Initially the paper's.
struct ControlShape {
  std::vector<int> inputs, outputs;

  ControlShape();
  ControlShape(std::vector<int> of_inputs, std::vector<int> of_outputs)
      : inputs(std::move(of_inputs)), outputs(std::move(of_outputs)) {}
};

/// The signals of a cell.
inline ControlShape shape_of(const std::vector<core::Input>& inputs,
                             const std::vector<core::Output>& outputs) {
  std::vector<int> in, out;
  for (const core::Input input : inputs) in.push_back(node_id(input));
  for (const core::Output output : outputs) out.push_back(node_id(output));
  return {std::move(in), std::move(out)};
}

inline ControlShape shape_of(const core::DevelopmentRules& rules) {
  return shape_of(rules.inputs, rules.outputs);
}

inline ControlShape::ControlShape()
    : ControlShape(shape_of(core::paper_inputs(), core::paper_outputs())) {}

/// A problem of one's own: so many inputs in the first slots and the bias, which is to be fed 1, in
/// the slot behind them. Both numbers from 1 to free_signals (std::invalid_argument otherwise).
ControlShape free_shape(int inputs, int outputs);

}  // namespace metamorph::evolve
