#pragma once

// Outcomes compared to the bit and told to the last digit: every field of them.

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <sstream>
#include <string>
#include <type_traits>

#include "metamorph/outcome_fields.h"

namespace metamorph::tests {

/// Every field of an outcome, to the last digit.
inline std::string text_of(const core::Outcome& outcome) {
  std::ostringstream text;
  text << std::hexfloat;
  core::for_each_field([&](const auto& field) {
    const auto& value = outcome.*field.member;
    using Value = std::remove_cvref_t<decltype(value)>;
    text << field.name << ' ';
    if constexpr (std::is_same_v<Value, std::array<double, 2>>) {
      text << value[0] << ' ' << value[1] << ' ';
    } else if constexpr (std::is_same_v<Value, core::Status>) {
      text << core::name(value) << ' ';
    } else {
      text << value << ' ';
    }
  });
  return text.str();
}

/// Whether two outcomes agree bit by bit; what differs is named.
inline ::testing::AssertionResult same_bits(const core::Outcome& a, const core::Outcome& b) {
  std::ostringstream differing;
  core::for_each_field([&](const auto& field) {
    // No type of a field has padding.
    if (std::memcmp(&(a.*field.member), &(b.*field.member), sizeof(a.*field.member)) != 0)
      differing << ' ' << field.name;
  });
  if (differing.str().empty()) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure()
         << "differ in" << differing.str() << "\n  " << text_of(a) << "\n  " << text_of(b);
}

}  // namespace metamorph::tests
