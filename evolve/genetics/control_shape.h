#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "metamorph/development.h"
#include "metamorph/signals.h"

namespace metamorph::evolve {

/// Which signals the control networks of a population have. Slots of a network follow these lists.
struct ControlShape {
  std::vector<core::Input> inputs = core::paper_inputs();
  std::vector<core::Output> outputs = core::paper_outputs();
};

inline ControlShape shape_of(const core::DevelopmentRules& rules) {
  return {rules.inputs, rules.outputs};
}

/// The node that stands for a signal in every genome, for ever: genomes of different experiments
/// and versions speak of the same nodes. The paper's have 0 to 12; whatever came later counts
/// downwards from -1, since hidden nodes start at 13.
inline constexpr std::array<int, core::input_signals.size()> input_ids = {0, 1, 2, 3, 4, 5, -1};
inline constexpr std::array<int, core::output_signals.size()> output_ids = {6, 7, 8, 9, 10, 11, 12};
inline constexpr int first_hidden = 13;
inline constexpr int least_id = std::min(*std::min_element(input_ids.begin(), input_ids.end()),
                                         *std::min_element(output_ids.begin(), output_ids.end()));

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
    if (ids[i] >= first_hidden) return false;
    for (std::size_t j = 0; j < i; ++j) {
      if (ids[i] == ids[j]) return false;
    }
  }
  return true;
}
}  // namespace detail
static_assert(detail::signal_ids_differ());

}  // namespace metamorph::evolve
