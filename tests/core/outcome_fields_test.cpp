// The list of an outcome's fields, and what is made from it.

#include "metamorph/outcome_fields.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

#include "tests/outcomes.h"

namespace metamorph::core {
namespace {

using Value = std::variant<std::string_view, std::int64_t, double, bool>;

/// Every column of a table, null where it has nothing to say.
std::map<std::string_view, Value> row(const Outcome& outcome, int& nulls) {
  std::map<std::string_view, Value> columns;
  nulls = 0;
  visit_columns(outcome, [&](const OutcomeColumn& column, auto value) {
    EXPECT_TRUE(columns.emplace(column.name, Value(value)).second) << column.name << " twice";
    EXPECT_FALSE(column.meaning.empty()) << column.name;
    nulls += column.applies ? 0 : 1;
  });
  return columns;
}

TEST(OutcomeFields, ColumnsHoldTheValues) {
  Outcome outcome;
  outcome.status = Status::speed;
  outcome.mean_position = {1.5, -2.5};
  outcome.cells = 7;
  outcome.steps = std::int64_t{1} << 40;
  outcome.near_step_limit = true;
  outcome.failed_value = 9;
  int nulls = 0;
  const auto columns = row(outcome, nulls);
  EXPECT_EQ(nulls, 1);  // it did not settle
  EXPECT_EQ(columns.at("status"), Value(std::string_view("speed")));
  EXPECT_EQ(columns.at("x"), Value(1.5));
  EXPECT_EQ(columns.at("y"), Value(-2.5));
  EXPECT_EQ(columns.at("body_cells"), Value(std::int64_t{7}));
  EXPECT_EQ(columns.at("steps"), Value(std::int64_t{1} << 40));
  EXPECT_EQ(columns.at("near_step_limit"), Value(true));
  EXPECT_EQ(columns.at("failed_value"), Value(9.0));
}

TEST(OutcomeFields, ApplyByStatusAndSettling) {
  Outcome outcome;
  int nulls = 0;
  row(outcome, nulls);
  EXPECT_EQ(nulls, 4);
  outcome.settle_step = 0.2;
  row(outcome, nulls);
  EXPECT_EQ(nulls, 3);
}

// Whichever field is other, the outcomes are: the comparison of the tests of equal bits sees it.
TEST(OutcomeFields, EachMakesADifference) {
  const Outcome plain;
  EXPECT_TRUE(tests::same_bits(plain, plain));
  for_each_field([&](const auto& field) {
    Outcome other;
    auto& value = other.*field.member;
    using Field = std::remove_cvref_t<decltype(value)>;
    if constexpr (std::is_same_v<Field, std::array<double, 2>>) {
      value[1] = -0.0;
    } else if constexpr (std::is_same_v<Field, Status>) {
      value = Status::empty;
    } else if constexpr (std::is_same_v<Field, bool>) {
      value = !value;
    } else {
      value += 1;
    }
    EXPECT_FALSE(tests::same_bits(plain, other)) << field.name;
    EXPECT_NE(tests::text_of(plain), tests::text_of(other)) << field.name;
  });
}

}  // namespace
}  // namespace metamorph::core
