#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/core/random_developments.h"

namespace metamorph::core {
namespace {

using testing::grow;
using testing::population;
using testing::same;

TEST(DevelopmentByThreads, BatchOrderAndThreadsDoNotChangeABit) {
  auto networks = population(12, 40);
  const std::vector<int> stages = {600, 1200};
  const auto batch = grow(networks, stages, 1);
  const auto threaded = grow(networks, stages, 2);
  std::reverse(networks.begin(), networks.end());
  const auto reversed = grow(networks, stages, 3);
  for (std::size_t i = 0; i < networks.size(); ++i) {
    EXPECT_TRUE(same(batch[i], threaded[i]));
    EXPECT_TRUE(same(batch[i], reversed[networks.size() - 1 - i]));
    EXPECT_TRUE(same(batch[i], grow({networks[networks.size() - 1 - i]}, stages).front()));
  }
}

}  // namespace
}  // namespace metamorph::core
