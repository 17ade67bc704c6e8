#include "kernels/cell_space.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace metamorph::kernels {
namespace {

/// Cells around the origin, nearer ones first; the padding lies in the origin.
std::vector<NodeRecord<float>> spiral(int cells) {
  std::vector<NodeRecord<float>> records(static_cast<std::size_t>(cells));
  for (int i = 0; i < cells; ++i) {
    const auto angle = static_cast<float>(i), radius = 1 + 0.1f * static_cast<float>(i);
    records[static_cast<std::size_t>(i)] = {radius * std::cos(angle), radius * std::sin(angle), 0,
                                            0};
  }
  records.resize(static_cast<std::size_t>(cells + Lanes<float>::width));
  return records;
}

TEST(CellSpace, SeesAnyCellButTheExceptedOneAndNoPadding) {
  for (int cells = 1; cells < 40; ++cells) {
    const auto records = spiral(cells);
    EXPECT_FALSE(is_space_taken(records.data(), cells, 0.0f, 0.0f, 0.95f, -1));
    EXPECT_TRUE(is_space_taken(records.data(), cells, 0.0f, 0.0f, 1.05f, -1));
    EXPECT_FALSE(is_space_taken(records.data(), cells, 0.0f, 0.0f, 1.05f, 0));
    const auto& last = records[static_cast<std::size_t>(cells - 1)];
    EXPECT_TRUE(is_space_taken(records.data(), cells, last.x, last.y, 1e-3f, -1));
    EXPECT_FALSE(is_space_taken(records.data(), cells, last.x, last.y, 1e-3f, cells - 1));
  }
}

TEST(CellSpace, TheLimitItselfIsTaken) {
  std::vector<NodeRecord<double>> records(1 + Lanes<double>::width);
  records[0].x = 3;
  EXPECT_TRUE(is_space_taken(records.data(), 1, 3.0, 0.5, 0.5, -1));
  EXPECT_FALSE(is_space_taken(records.data(), 1, 3.0, std::nextafter(0.5, 1.0), 0.5, -1));
}

}  // namespace
}  // namespace metamorph::kernels
