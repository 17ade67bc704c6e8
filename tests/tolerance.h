#pragma once

// Every tolerance of the physics tests, each derived from the order of the method, the step and the
// precision. METAMORPH_TOLERANCE_SCALE multiplies all of them: at 0 every inexact test fails and
// prints its true residual.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace metamorph::tests {

inline double tolerance_scale() {
  static const double scale = [] {
    const char* text = std::getenv("METAMORPH_TOLERANCE_SCALE");
    return text == nullptr ? 1.0 : std::atof(text);
  }();
  return scale;
}

/// |residual| <= scaled tolerance; says both when it is not.
inline testing::AssertionResult within(double residual, double tolerance) {
  const double size = std::fabs(residual);
  if (size <= tolerance * tolerance_scale()) return testing::AssertionSuccess();
  return testing::AssertionFailure()
         << "residual " << size << ", tolerance " << tolerance * tolerance_scale();
}

/// Unit round-off: half the distance from 1 to the next number.
inline constexpr double round_off_64 = 0x1p-53;
inline constexpr double round_off_32 = 0x1p-24;

namespace tolerance {

/// A sum of terms, each the result of `operations` roundings, over the sum of the magnitudes.
constexpr double sum(double round_off, int operations) { return round_off * operations; }

/// Rounding of a quantity of size `magnitude` over `steps` additions: errors of independent sign
/// grow like the root of their number; eight standard deviations.
inline double drift(double round_off, double magnitude, double steps) {
  return 8 * round_off * magnitude * std::sqrt(steps);
}

/// The same where every step may round to the same side.
constexpr double growth(double round_off, double magnitude, double steps) {
  return round_off * magnitude * steps;
}

/// A central difference with step delta of a function of size `value`, whose third derivative is at
/// most `third`: truncation delta^2/6 third, cancellation round-off value/delta.
constexpr double central_difference(double delta, double value, double third) {
  return delta * delta / 6 * third + 4 * round_off_64 * value / delta;
}

/// Observed order of convergence against the theoretical one (NUMERICS section 8, tests 2, 9, 20).
inline constexpr double order = 0.1;

}  // namespace tolerance

}  // namespace metamorph::tests
