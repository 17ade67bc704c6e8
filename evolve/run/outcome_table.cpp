#include "evolve/run/outcome_table.h"

#include <string_view>
#include <type_traits>

#include "metamorph/outcome_fields.h"

namespace metamorph::evolve {
namespace {

template <class Value>
constexpr const char* type_name() {
  if constexpr (std::is_same_v<Value, double>) return "REAL";
  if constexpr (std::is_same_v<Value, std::string_view>) return "TEXT NOT NULL";
  return "INTEGER";
}

}  // namespace

std::string outcome_columns() {
  std::string sql;
  core::visit_columns({}, [&](const core::OutcomeColumn& column, auto value) {
    sql.append(sql.empty() ? "" : ", ").append(column.name).append(" ");
    sql.append(type_name<decltype(value)>());
  });
  return sql;
}

std::string outcome_insertion() {
  std::string places = "?, ?, ?, ?, ?, ?";
  core::visit_columns({}, [&](const auto&, const auto&) { places += ", ?"; });
  return "INSERT INTO outcomes VALUES (" + places + ")";
}

void bind_outcome(Statement& statement, const core::Outcome& outcome) {
  core::visit_columns(outcome, [&](const core::OutcomeColumn& column, auto value) {
    if (!column.applies) {
      statement.bind_null();
    } else if constexpr (std::is_same_v<decltype(value), bool>) {
      statement.bind(std::int64_t{value});
    } else {
      statement.bind(value);
    }
  });
}

}  // namespace metamorph::evolve
