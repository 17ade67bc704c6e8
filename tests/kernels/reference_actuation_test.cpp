#include "kernels/reference/actuation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/tolerance.h"

namespace metamorph::tests {
namespace {

namespace ref = kernels::reference;

constexpr double pi = std::numbers::pi;

TEST(Actuation, IsEquationThreeWithBothEnds) {
  const std::vector<ref::Edge> springs = {{0, 1}, {1, 2}};
  const std::vector<double> rest = {1.25, 0.75}, period = {30, 50, 120}, phase = {0.3, -1.1, 2.9};
  std::vector<double> length(2);
  for (const double t : {0.0, 0.1, 7.3, 44.0, 299.9}) {
    ref::actuate(springs, rest, {period, phase}, 0.15, t, length);
    for (std::size_t s = 0; s < 2; ++s) {
      const double expected =
          rest[s] * (1 + 0.15 * std::sin(2 * pi * t / period[s] + phase[s]) +
                     0.15 * std::sin(2 * pi * t / period[s + 1] + phase[s + 1]));
      // Phases of up to 65 radians, rounded in either formula, times A L0 < 0.2.
      EXPECT_TRUE(within(length[s] - expected, 4 * 65 * 0.2 * round_off_64)) << "t " << t;
    }
  }
}

TEST(Actuation, RampRisesEvenlyFromZeroToOneAndStays) {
  EXPECT_EQ(ref::ramp(0, 40), 0);
  EXPECT_EQ(ref::ramp(10, 40), 0.25);
  EXPECT_EQ(ref::ramp(40, 40), 1);
  EXPECT_EQ(ref::ramp(600, 40), 1);
  EXPECT_EQ(ref::ramp(0, 0), 1);  // no ramp
}

TEST(Actuation, RepeatsAfterAMillionPeriods) {
  // With a period and times that are exact in binary, whole periods leave no trace.
  for (int i = 0; i < 64; ++i) {
    const double t = 0.5 * i;
    EXPECT_EQ(ref::oscillation(t + 32e6, 32, 0.7), ref::oscillation(t, 32, 0.7));
  }
  // With others the number of cycles carries one rounding: 2 pi 1e6 u.
  EXPECT_TRUE(within(ref::oscillation(7 + 37.3e6, 37.3, 0.7) - ref::oscillation(7, 37.3, 0.7),
                     2 * pi * 1e6 * 4 * round_off_64));
}

TEST(Actuation, ShiftsByHalfAPeriodTurnTheSign) {
  for (const double t : {0.0, 3.0, 11.5})
    EXPECT_TRUE(within(ref::oscillation(t + 32, 64, 0.4) + ref::oscillation(t, 64, 0.4),
                       16 * round_off_64));
}

}  // namespace
}  // namespace metamorph::tests
