#include "evolve/search/nondominated.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "tests/evolve/random_genomes.h"

namespace metamorph::evolve {
namespace {

using ::testing::ElementsAre;
using testing::test_stream;
using Points = std::vector<std::vector<double>>;

constexpr double infinity = std::numeric_limits<double>::infinity();

Points any_points(RandomStream& stream, std::size_t objectives) {
  Points points(1 + stream.below(30));
  for (auto& point : points) {
    for (std::size_t o = 0; o < objectives; ++o) point.push_back(stream.below(6));
  }
  return points;
}

bool dominates(const Points& points, std::size_t a, std::size_t b) {
  bool better = false;
  for (std::size_t o = 0; o < points[a].size(); ++o) {
    if (points[a][o] < points[b][o]) return false;
    better |= points[a][o] > points[b][o];
  }
  return better || a < b;
}

// By peeling: whoever is dominated by nobody who is left makes the next front.
TEST(FrontNumbers, AgreeWithPeeling) {
  RandomStream stream = test_stream(41);
  for (int round = 0; round < 200; ++round) {
    const Points points = any_points(stream, 1 + static_cast<std::size_t>(round) % 4);
    std::vector<int> expected(points.size(), -1);
    std::size_t left = points.size();
    for (int front = 0; left > 0; ++front) {
      std::vector<std::size_t> peeled;
      for (std::size_t b = 0; b < points.size(); ++b) {
        bool dominated = false;
        for (std::size_t a = 0; a < points.size(); ++a) {
          dominated |= a != b && expected[a] < 0 && dominates(points, a, b);
        }
        if (expected[b] < 0 && !dominated) peeled.push_back(b);
      }
      for (const std::size_t p : peeled) expected[p] = front;
      left -= peeled.size();
    }
    EXPECT_EQ(front_numbers(points), expected);
  }
}

TEST(FrontNumbers, OfEqualOnesTheFirstIsAhead) {
  EXPECT_THAT(front_numbers(Points{{1, 2}, {1, 2}, {2, 1}, {1, 2}}), ElementsAre(0, 1, 0, 2));
}

TEST(Crowding, ByHand) {
  const Points points = {{0, 10}, {9, 9}, {1, 6}, {4, 5}, {5, 0}};
  // Without the second: gaps (4 - 0) / 5 + (10 - 5) / 10, (5 - 1) / 5 + (6 - 0) / 10.
  const std::vector<std::size_t> members = {0, 2, 3, 4};
  const std::vector<double> crowding = crowding_distances(points, members);
  EXPECT_EQ(crowding[0], infinity);
  EXPECT_NEAR(crowding[1], 0.8 + 0.5, 1e-15);
  EXPECT_NEAR(crowding[2], 0.8 + 0.6, 1e-15);
  EXPECT_EQ(crowding[3], infinity);
  // An objective in which all are equal says nothing.
  EXPECT_THAT(crowding_distances(Points{{1, 1}, {1, 2}, {1, 5}}, std::vector<std::size_t>{0, 1, 2}),
              ElementsAre(infinity, 1, infinity));
  EXPECT_THAT(crowding_distances(Points{{3, 3}}, std::vector<std::size_t>{0}), ElementsAre(0));
}

TEST(Rank, OrdersByFrontThenCrowdingThenPlace) {
  RandomStream stream = test_stream(42);
  for (int round = 0; round < 100; ++round) {
    const Points points = any_points(stream, 2);
    const Ranking ranking = rank(points);
    EXPECT_EQ(ranking.front, front_numbers(points));
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    EXPECT_TRUE(std::is_permutation(order.begin(), order.end(), ranking.order.begin(),
                                    ranking.order.end()));
    for (std::size_t i = 1; i < order.size(); ++i) {
      const std::size_t a = ranking.order[i - 1], b = ranking.order[i];
      const auto key = [&](std::size_t p) {
        return std::tuple(ranking.front[p], -ranking.crowding[p], p);
      };
      EXPECT_LT(key(a), key(b));
    }
    std::vector<std::size_t> first;
    for (const std::size_t p : order) {
      if (ranking.front[p] == 0) first.push_back(p);
    }
    const std::vector<double> crowding = crowding_distances(points, first);
    for (std::size_t m = 0; m < first.size(); ++m) {
      EXPECT_EQ(ranking.crowding[first[m]], crowding[m]);
    }
  }
}

}  // namespace
}  // namespace metamorph::evolve
