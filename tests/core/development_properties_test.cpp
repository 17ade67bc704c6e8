#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/development/delaunay.h"
#include "core/development/developer.h"
#include "core/development/links.h"
#include "metamorph/development.h"
#include "tests/core/random_developments.h"

namespace metamorph::core {
namespace {

using testing::grow;
using testing::population;
using testing::same;

RC_GTEST_PROP(RandomDevelopment, KeepsItsBooksAndItsGeometry, ()) {
  DevelopmentRules rules;
  rules.max_cells = *rc::gen::inRange(1, 257);
  const int stage = *rc::gen::inRange(0, 1201);
  const auto networks = population(*rc::gen::inRange<std::uint64_t>(0, 1000000), 4);
  for (const auto& stages : grow(networks, {stage}, 1, rules)) {
    const Embryo& e = stages.front();
    const Index n = e.cell_count();
    RC_ASSERT(n <= rules.max_cells);
    RC_ASSERT(e.status == (n == 0 ? Status::empty : Status::ok));
    RC_ASSERT(e.created - e.died == n);
    for (Index i = 0; i < n; ++i) {
      const auto c = static_cast<std::size_t>(i);
      RC_ASSERT((i == 0 || e.id[c - 1] < e.id[c]));
      RC_ASSERT(e.id[c] < e.created);
      RC_ASSERT(e.mother[c] < e.id[c]);
      RC_ASSERT((e.mother[c] == -1) == (e.id[c] == 0));
      RC_ASSERT(e.birth_step[c] % 30 == 0);
      RC_ASSERT((e.birth_step[c] < stage || e.id[c] == 0));
      RC_ASSERT((e.period[c] >= 30 && e.period[c] <= 120));
      RC_ASSERT(std::fabs(e.phase[c]) <= std::acos(-1.0));
      RC_ASSERT(std::fabs(e.orientation[c]) <= std::acos(-1.0));
    }
    Triangulation t;
    triangulate(e.x, e.y, t);
    RC_ASSERT(e.faces == t.faces);
    std::vector<std::array<Index, 2>> links;
    LinkSelection().select(e.x, e.y, rules.link_limit, t.edges, links);
    RC_ASSERT(e.links == links);
  }
}

TEST(RandomDevelopment, TakingAnEmbryoOutLeavesNoTrace) {
  const auto networks = population(11, 60);
  const auto once = grow(networks, {1200});
  const auto twice = grow(networks, {600, 1200});
  const auto often = grow(networks, {0, 1, 15, 30, 299, 595, 600, 601, 1199, 1200});
  bool grown = false;
  for (std::size_t i = 0; i < networks.size(); ++i) {
    EXPECT_TRUE(same(twice[i][1], once[i][0])) << i;
    EXPECT_TRUE(same(often[i][9], once[i][0])) << i;
    EXPECT_TRUE(same(often[i][6], twice[i][0])) << i;
    grown = grown || once[i][0].cell_count() > 50;
  }
  EXPECT_TRUE(grown);
}

// One update decides alike in either precision unless a network's output lies within some 1e-6 of
// a threshold, and within the first few updates positions differ by little more than that.
TEST(RandomDevelopment, FloatFollowsDoubleAtFirst) {
  const std::vector<int> stages = {100};
  Developer<float> in_float({});
  Developer<double> in_double({});
  int grown = 0;
  for (const Network& network : population(13, 100)) {
    const Controls alone = {{&network, 1}, {}};
    const Embryo a = in_float(alone, stages).front(), b = in_double(alone, stages).front();
    ASSERT_EQ(a.id, b.id);
    ASSERT_EQ(a.links, b.links);
    for (std::size_t i = 0; i < a.x.size(); ++i) {
      EXPECT_NEAR(a.x[i], b.x[i], 1e-4);
      EXPECT_NEAR(a.y[i], b.y[i], 1e-4);
      EXPECT_NEAR(a.phase[i], b.phase[i], 1e-4);
    }
    grown += a.cell_count() > 4;
  }
  EXPECT_GT(grown, 10);
}

}  // namespace
}  // namespace metamorph::core
