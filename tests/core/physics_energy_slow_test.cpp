#include <gtest/gtest.h>

#include <algorithm>

#include "tests/core/energy_record.h"
#include "tests/tolerance.h"

namespace metamorph::tests {
namespace {

TEST(EnergyOverLongTimes, HasNoTrendWithDriftKickDrift) {
  const EnergyRecord record = energy_record(core::ReferenceMethod::drift_kick_drift, 0.2, 4000);
  EXPECT_TRUE(within(std::max(record.first_half, record.second_half), leapfrog_energy_error(0.2)));
  EXPECT_TRUE(within(growth(record), 0.25));
}

}  // namespace
}  // namespace metamorph::tests
