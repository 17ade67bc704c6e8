#include "evolve/genetics/distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "tests/evolve/random_genomes.h"

namespace metamorph::evolve {
namespace {

using testing::hand_made;
using testing::restless;
using testing::wander;

// The formula link by link: factor * mean difference of the shared + number of the others.
double plain_distance(const Genome& a, const Genome& b, double factor) {
  std::map<int, double> weights;
  for (const LinkGene& link : a.links) weights[link.innovation] = link.weight;
  double sum = 0;
  std::size_t shared = 0;
  for (const LinkGene& link : b.links) {
    const auto same = weights.find(link.innovation);
    if (same == weights.end()) continue;
    sum += std::abs(link.weight - same->second);
    ++shared;
  }
  const double others = static_cast<double>(a.links.size() + b.links.size() - 2 * shared);
  return others + (shared > 0 ? factor * sum / static_cast<double>(shared) : 0);
}

TEST(Distance, HandMade) {
  const Genome a = hand_made({}, {{0, 0, 6, 1}, {1, 0, 7, 2}, {2, 0, 8, 3}, {5, 0, 9, 4}});
  const Genome b = hand_made({}, {{0, 0, 6, 2}, {2, 0, 8, -1}, {3, 0, 10, 7}});
  const Genome c = hand_made({}, {{7, 0, 11, 1}});
  EXPECT_EQ(distance(a, a, 1.5), 0);
  // Shared 0 and 2 with differences 1 and 4; not shared 1, 5 and 3.
  EXPECT_EQ(distance(a, b, 1.5), 3 + 1.5 * 2.5);
  EXPECT_EQ(distance(a, b, 0), 3);
  EXPECT_EQ(distance(a, c, 1.5), 5);
  EXPECT_EQ(distance(hand_made({}, {}), c, 1.5), 1);
  EXPECT_EQ(distance(hand_made({}, {}), hand_made({}, {}), 1.5), 0);
}

TEST(Distance, AgreesWithThePlainFormulaAndIsSymmetric) {
  for (const int rounds : {0, 2, 10, 60}) {
    const std::vector<Genome> genomes =
        wander(restless(), 40, rounds, 100 + static_cast<std::uint32_t>(rounds));
    for (const Genome& a : genomes) {
      for (const Genome& b : genomes) {
        const double expected = plain_distance(a, b, 1.5);
        // The sums differ in order only: below 200 terms of at most 16, each rounded to 2^-53.
        ASSERT_NEAR(distance(a, b, 1.5), expected, 1e-12 * (1 + expected));
        ASSERT_EQ(distance(a, b, 1.5), distance(b, a, 1.5));
        ASSERT_EQ(distance(a, b, 0), plain_distance(a, b, 0));
      }
    }
  }
}

TEST(Distance, ALimitDecidesOnlyHowFarItIsComputed) {
  const std::vector<Genome> genomes = wander(restless(), 40, 20, 7);
  for (const Genome& a : genomes) {
    for (const Genome& b : genomes) {
      const double full = distance(a, b, 1.5);
      for (const double limit : {0.2, 3.0, 5.0, 12.0}) {
        const double limited = distance(link_arrays(a), link_arrays(b), 1.5, limit);
        ASSERT_EQ(limited < limit, full < limit);
        if (full < limit) {
          ASSERT_EQ(limited, full);
        }
      }
    }
  }
}

}  // namespace
}  // namespace metamorph::evolve
