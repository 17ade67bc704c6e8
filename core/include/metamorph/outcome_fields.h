#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "metamorph/outcome.h"
#include "metamorph/status.h"

namespace metamorph::core {

/// Of which outcomes a field says something.
enum class FieldOf {
  every_outcome,
  settling,  ///< where the body settled before it was actuated
  failure    ///< where is_failure(status)
};

/// One field of an outcome.
template <class Value>
struct OutcomeField {
  std::string_view name;    ///< of the member; its key in JSON
  std::string_view column;  ///< in a table of numbers; "", where it has two (mean_position: x, y)
  Value Outcome::* member;
  std::string_view meaning;  ///< with its unit
  FieldOf of = FieldOf::every_outcome;

  /// Whether the field says something of this outcome.
  constexpr bool applies(const Outcome& outcome) const {
    return of == FieldOf::every_outcome || (of == FieldOf::settling && outcome.settle_step > 0) ||
           (of == FieldOf::failure && is_failure(outcome.status));
  }
};

/// The one list of what an outcome has, in the order in which files and tables show it.
inline constexpr std::tuple outcome_fields{
    OutcomeField<Status>{"status", "status", &Outcome::status, "how the evaluation ended"},
    OutcomeField<double>{"distance", "distance", &Outcome::distance, "by the scene's rule, d"},
    OutcomeField<std::array<double, 2>>{"mean_position", "", &Outcome::mean_position,
                                        "final mean node position, d"},
    OutcomeField<int>{"cells", "body_cells", &Outcome::cells, "nodes of the body"},
    OutcomeField<int>{"springs", "springs", &Outcome::springs, "springs of the body"},
    OutcomeField<int>{"triangles", "triangles", &Outcome::triangles, "triangles of the body"},
    OutcomeField<std::int64_t>{"steps", "steps", &Outcome::steps,
                               "integrator steps taken, settling included"},
    OutcomeField<double>{"step", "step", &Outcome::step, "time units per step of the run"},
    OutcomeField<double>{"settle_step", "settle_step", &Outcome::settle_step,
                         "time units per step of settling", FieldOf::settling},
    OutcomeField<bool>{"near_step_limit", "near_step_limit", &Outcome::near_step_limit,
                       "whether a step takes more of its limit than the margin"},
    OutcomeField<double>{"settle_time", "settle_time", &Outcome::settle_time,
                         "time units until quiet or timed out"},
    OutcomeField<double>{"min_area_ratio", "min_area_ratio", &Outcome::min_area_ratio,
                         "smallest S/S0 seen"},
    OutcomeField<double>{"max_speed", "max_speed", &Outcome::max_speed,
                         "largest node speed seen, d per time unit"},
    OutcomeField<double>{"height", "height", &Outcome::height,
                         "of the body as actuation begins, d"},
    OutcomeField<double>{"stance", "stance", &Outcome::stance,
                         "share of time on the ground of the nodes that touch it"},
    OutcomeField<double>{"gait_frequency", "gait_frequency", &Outcome::gait_frequency,
                         "at which the mean node position moves most, 1/time unit"},
    OutcomeField<double>{"longest_spring", "longest_spring", &Outcome::longest_spring,
                         "longest rest length, d"},
    OutcomeField<double>{"long_spring_share", "long_spring_share", &Outcome::long_spring_share,
                         "share of springs with rest length above 1.5 d"},
    OutcomeField<std::int64_t>{"failed_step", "failed_step", &Outcome::failed_step,
                               "integrator step at which the failure was detected",
                               FieldOf::failure},
    OutcomeField<int>{"failed_index", "failed_index", &Outcome::failed_index,
                      "node, triangle or spring, by status", FieldOf::failure},
    OutcomeField<double>{"failed_value", "failed_value", &Outcome::failed_value,
                         "speed, area ratio, largest step or node, by status", FieldOf::failure}};

/// Calls visit(field) for every field, in order.
template <class Visit>
constexpr void for_each_field(Visit&& visit) {
  std::apply([&](const auto&... field) { (visit(field), ...); }, outcome_fields);
}

/// One column of a table of outcomes.
struct OutcomeColumn {
  std::string_view name;
  std::string_view meaning;  ///< with its unit
  bool applies;              ///< false: the table has nothing to say here (null)
};

/// Calls visit(column, value) for every column of a table of outcomes, in order; `value` is text
/// (std::string_view), a whole number (std::int64_t), a real number (double) or bool, always the
/// same type in the same column. Columns and their types without an outcome: visit Outcome{}.
template <class Visit>
void visit_columns(const Outcome& outcome, Visit&& visit) {
  for_each_field([&](const auto& field) {
    const auto& value = outcome.*field.member;
    using Value = std::remove_cvref_t<decltype(value)>;
    const bool applies = field.applies(outcome);
    const OutcomeColumn column{field.column, field.meaning, applies};
    if constexpr (std::is_same_v<Value, std::array<double, 2>>) {
      visit(OutcomeColumn{"x", field.meaning, applies}, value[0]);
      visit(OutcomeColumn{"y", field.meaning, applies}, value[1]);
    } else if constexpr (std::is_same_v<Value, Status>) {
      visit(column, name(value));
    } else if constexpr (std::is_same_v<Value, double> || std::is_same_v<Value, bool>) {
      visit(column, value);
    } else {
      visit(column, std::int64_t{value});
    }
  });
}

// What is new in Outcome must be listed above: the binding names as many members as there are, and
// each of them must be one field's.
static_assert([] {
  const Outcome outcome;
  const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u] = outcome;
  const auto times_listed = [&outcome](const auto& member) {
    int times = 0;
    for_each_field([&](const auto& field) {
      const auto& value = outcome.*field.member;
      if constexpr (std::is_same_v<decltype(value), decltype(member)>) times += &value == &member;
    });
    return times;
  };
  return std::apply([&](const auto&... member) { return ((times_listed(member) == 1) && ...); },
                    std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u));
}());

}  // namespace metamorph::core
