#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "core/development/neighbour_table.h"

namespace metamorph::core {
namespace {

using Link = std::array<Index, 2>;
constexpr int record_bytes = 16;
constexpr int lanes = kernels::cell_lanes;

/// The table says what the set of links says, in all its forms.
void expect_holds(const NeighbourTable& table, const std::set<Link>& links, Index cells) {
  ASSERT_EQ(table.cell_count(), cells);
  EXPECT_EQ(table.links(), std::vector<Link>(links.begin(), links.end()));
  std::vector<std::vector<int>> neighbours(static_cast<std::size_t>(cells));
  for (const auto& [i, j] : links) {
    neighbours[static_cast<std::size_t>(i)].push_back(j);
    neighbours[static_cast<std::size_t>(j)].push_back(i);
  }
  int lowest = 0;
  const auto rings = table.rings();
  ASSERT_EQ(rings.groups, (cells + lanes - 1) / lanes);
  for (Index i = 0; i < rings.groups * lanes; ++i) {
    const bool is_cell = i < cells;
    auto expected = is_cell ? neighbours[static_cast<std::size_t>(i)] : std::vector<int>();
    std::sort(expected.begin(), expected.end());
    if (is_cell) {
      std::vector<int> listed;
      for (const int j : table.of(i)) listed.push_back(j);
      EXPECT_EQ(listed, expected);
      EXPECT_EQ(table.of(i).size(), static_cast<int>(expected.size()));
      lowest += expected.empty() || expected.front() > i;
    }
    // The slots of the group: the same, then the cell itself.
    const int first = rings.first_slot[i / lanes], end = rings.end_slot[i / lanes];
    ASSERT_LE(static_cast<int>(expected.size()), end - first);
    expected.resize(static_cast<std::size_t>(end - first), i);
    for (int s = first; s < end; ++s) {
      EXPECT_EQ(
          rings.neighbour[s * lanes + i % lanes],
          static_cast<std::uint32_t>(expected[static_cast<std::size_t>(s - first)]) * record_bytes);
    }
  }
  EXPECT_EQ(table.lowest_count(), lowest);
}

RC_GTEST_PROP(NeighbourTable, HoldsTheLinksThatCameAndDidNotGo, ()) {
  NeighbourTable table(record_bytes);
  std::set<Link> links;
  Index cells = 0;
  const auto few = *rc::gen::inRange(2, 60);
  table.reset(0);
  for (int round = 0; round < 4; ++round) {
    cells += *rc::gen::inRange(0, few);
    table.grow(cells);
    if (cells < 2) continue;
    for (int n = 0; n < 100; ++n) {
      const Index i = *rc::gen::inRange(0, cells - 1), j = *rc::gen::inRange(i + 1, cells);
      if (links.insert({i, j}).second) {
        table.link(i, j);
      } else {
        table.unlink(j, i);
        links.erase({i, j});
      }
    }
    expect_holds(table, links, cells);
  }
  table.reset(3);
  table.link(2, 0);
  expect_holds(table, {{0, 2}}, 3);
}

TEST(NeighbourTable, GroupsAreAsDeepAsTheirCells) {
  NeighbourTable table(record_bytes);
  table.reset(40);
  for (Index j = 1; j < 40; ++j) table.link(0, j);  // more than there is room for at first
  const auto depth = [&](int g) { return table.rings().end_slot[g] - table.rings().first_slot[g]; };
  EXPECT_EQ(depth(0), 39);
  EXPECT_EQ(depth(1), 1);
  for (Index j = 4; j < 40; ++j) table.unlink(0, j);
  EXPECT_EQ(depth(0), 3);
  EXPECT_EQ(depth(1), 0);
  expect_holds(table, {{0, 1}, {0, 2}, {0, 3}}, 40);
}

}  // namespace
}  // namespace metamorph::core
