#include <gtest/gtest.h>

#include "metamorph/locomotion.h"
#include "tests/core/short_tasks.h"
#include "tests/outcomes.h"

namespace metamorph::core {
namespace {

using tests::same_bits;
using tests::Tasks;

class BatchByThreads : public testing::TestWithParam<Precision> {
 protected:
  LocomotionOptions options(int threads) const {
    return {.precision = GetParam(), .threads = threads};
  }
};

TEST_P(BatchByThreads, EqualsItselfForAnyNumber) {
  const Tasks all(60);
  const auto one = simulate(all.tasks, options(1));
  for (const int threads : {2, 3, 7}) {
    const auto many = simulate(all.tasks, options(threads));
    for (std::size_t i = 0; i < all.tasks.size(); ++i) {
      EXPECT_TRUE(same_bits(one[i], many[i])) << "task " << i << ", " << threads << " threads";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, BatchByThreads, testing::Values(Precision::float32, Precision::float64),
                         [](const auto& param) {
                           return param.param == Precision::float32 ? "Float32" : "Float64";
                         });

}  // namespace
}  // namespace metamorph::core
