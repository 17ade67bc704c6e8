#include "core/development/link_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace metamorph::core {
namespace {

using Links = std::vector<std::array<Index, 2>>;
using ::testing::ElementsAre;

// A flat rhombus: the edge 1-2 across it is its short diagonal, hence Delaunay; the long one, 0-3,
// is not.
const std::vector<double> x = {0, 0.8, 0.8, 1.6}, y = {0, 0.5, -0.5, 0};
const Links full = {{0, 1}, {0, 2}, {1, 2}, {1, 3}, {2, 3}};
constexpr double limit = 1.5;

TEST(LinkCheck, CountsWhatItCompares) {
  LinkCheck check;
  check.compare(0, x, y, limit, full);
  check.compare(10, x, y, limit, full);
  EXPECT_TRUE(check.ok());
  EXPECT_EQ(check.renewals, 2);
  EXPECT_EQ(check.links, 10);
  EXPECT_EQ(difference_text(check), "");
}

TEST(LinkCheck, KeepsTheFirstDifference) {
  LinkCheck check;
  check.compare(0, x, y, limit, full);
  check.compare(10, x, y, limit, Links{{0, 1}, {0, 2}, {0, 3}, {1, 3}, {2, 3}});
  check.compare(20, x, y, limit, Links{});
  EXPECT_FALSE(check.ok());
  EXPECT_EQ(check.step, 10);
  EXPECT_THAT(check.missing, ElementsAre(std::array<Index, 2>{1, 2}));
  EXPECT_THAT(check.surplus, ElementsAre(std::array<Index, 2>{0, 3}));
  EXPECT_EQ(check.renewals, 3);
  EXPECT_EQ(difference_text(check),
            "step 10 of development: other links than those of a full triangulation: missing 1-2; "
            "surplus 0-3");
}

TEST(LinkCheck, ALostLinkIsADifference) {
  for (std::size_t lost = 0; lost < full.size(); ++lost) {
    Links links = full;
    links.erase(links.begin() + static_cast<std::ptrdiff_t>(lost));
    LinkCheck check;
    check.compare(0, x, y, limit, links);
    EXPECT_THAT(check.missing, ElementsAre(full[lost]));
    EXPECT_TRUE(check.surplus.empty());
  }
}

TEST(LinkCheck, NamesTenLinksAndCountsTheRest) {
  LinkCheck check;
  check.step = 0;
  for (Index i = 0; i < 12; ++i) check.missing.push_back({i, 20});
  const std::string text = difference_text(check);
  EXPECT_THAT(text, ::testing::HasSubstr(" 9-20 and 2 more; surplus none"));
}

}  // namespace
}  // namespace metamorph::core
