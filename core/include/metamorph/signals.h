#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

namespace metamorph::core {

/// What a cell can tell its control network (MODEL section 2, Control network).
enum class Input { time, x, y, morphogen_1, morphogen_2, bias, neighbours };

/// What a control network can tell its cell.
enum class Output { inhibit, angle, die, morphogen_1, morphogen_2, period, phase };

/// A signal as experiments name it, and what its value is.
template <class Signal>
struct SignalEntry {
  Signal signal;
  std::string_view name;
  std::string_view meaning;
};

/// Every input, in the order of the enum. A new one costs a line here, its value in
/// core/development/control.h and the id of its node in evolve/genetics/control_shape.h.
inline constexpr std::array<SignalEntry<Input>, 7> input_signals = {{
    {Input::time, "time", "share of development that is over, 0 to 1"},
    {Input::x, "x", "position along x, coordinate_scale is 1"},
    {Input::y, "y", "position along y, coordinate_scale is 1"},
    {Input::morphogen_1, "morphogen_1", "mean of morphogen 1 over the linked neighbours"},
    {Input::morphogen_2, "morphogen_2", "mean of morphogen 2 over the linked neighbours"},
    {Input::bias, "bias", "1, always"},
    {Input::neighbours, "neighbours", "number of linked neighbours / 6; not in the paper"},
}};

/// Every output, in the order of the enum. One that a network does not have reads 0.
inline constexpr std::array<SignalEntry<Output>, 7> output_signals = {{
    {Output::inhibit, "inhibit", "above 0: the cell does not divide"},
    {Output::angle, "angle", "turn from the neighbours' mean orientation, times pi"},
    {Output::die, "die", "above 0: the cell dies"},
    {Output::morphogen_1, "morphogen_1", "the cell's morphogen 1"},
    {Output::morphogen_2, "morphogen_2", "the cell's morphogen 2"},
    {Output::period, "period", "-0.5 to 0.5 is period_min to period_max"},
    {Output::phase, "phase", "phase shift, times pi"},
}};

namespace detail {
template <class Table>
constexpr bool in_order_of_the_enum(const Table& table) {
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (static_cast<std::size_t>(table[i].signal) != i || table[i].name.empty()) return false;
  }
  return true;
}
}  // namespace detail
static_assert(detail::in_order_of_the_enum(input_signals));
static_assert(detail::in_order_of_the_enum(output_signals));

constexpr std::string_view name(Input input) {
  return input_signals[static_cast<std::size_t>(input)].name;
}
constexpr std::string_view name(Output output) {
  return output_signals[static_cast<std::size_t>(output)].name;
}

/// The six inputs of the paper.
inline std::vector<Input> paper_inputs() {
  return {Input::time, Input::x, Input::y, Input::morphogen_1, Input::morphogen_2, Input::bias};
}

/// The seven outputs of the paper.
inline std::vector<Output> paper_outputs() {
  return {Output::inhibit,     Output::angle,  Output::die,  Output::morphogen_1,
          Output::morphogen_2, Output::period, Output::phase};
}

}  // namespace metamorph::core
