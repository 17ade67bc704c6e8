#include "evolve/search/niches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "tests/evolve/random_genomes.h"

namespace metamorph::evolve {
namespace {

using testing::test_stream;

TEST(Niches, OfAGridCountTheLastAxisFastest) {
  const Niches niches = Niches::grid({3, 4});
  EXPECT_EQ(niches.count(), 12);
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 4; ++b) {
      EXPECT_EQ(niches.niche_of(std::vector<double>{(a + 0.5) / 3, (b + 0.5) / 4}), 4 * a + b);
      // The lower border belongs to a bin.
      EXPECT_EQ(niches.niche_of(std::vector<double>{a / 3.0 + 1e-12, b / 4.0}), 4 * a + b);
    }
  }
}

TEST(Niches, WhoeverIsOutsideBelongsToTheBorder) {
  const Niches niches = Niches::grid({5, 2});
  const double far = std::numeric_limits<double>::infinity();
  EXPECT_EQ(niches.niche_of(std::vector<double>{-7, 0}), 0);
  EXPECT_EQ(niches.niche_of(std::vector<double>{1, 1}), 9);
  EXPECT_EQ(niches.niche_of(std::vector<double>{1.5, 0.2}), 8);
  EXPECT_EQ(niches.niche_of(std::vector<double>{0.5, far}), 5);
  EXPECT_EQ(niches.niche_of(std::vector<double>{-far, -far}), 0);

  const Niches cells = Niches::centroidal(10, 2, 1);
  RandomStream stream = test_stream(32);
  for (int i = 0; i < 200; ++i) {
    std::vector<double> position = {4 * stream.triangular(), 4 * stream.triangular()};
    std::vector<double> inside = position;
    for (double& x : inside) x = std::clamp(x, 0.0, 1.0);
    EXPECT_EQ(cells.niche_of(position), cells.niche_of(inside));
  }
}

TEST(Niches, OfCentresAreTheNearest) {
  for (const int axes : {1, 2, 4}) {
    const Niches niches = Niches::centroidal(30, axes, 1);
    ASSERT_EQ(niches.count(), 30);
    const std::vector<double>& centres = niches.centres();
    ASSERT_EQ(centres.size(), static_cast<std::size_t>(30 * axes));
    for (const double x : centres) {
      EXPECT_GT(x, 0);
      EXPECT_LT(x, 1);
    }
    RandomStream stream = test_stream(33);
    std::set<int> met;
    for (int i = 0; i < 3000; ++i) {
      std::vector<double> position;
      for (int a = 0; a < axes; ++a) position.push_back(stream.uniform());
      int best = -1;
      double least = 1e9;
      for (int c = 0; c < 30; ++c) {
        double square = 0;
        for (int a = 0; a < axes; ++a) {
          square += std::pow(centres[static_cast<std::size_t>(c * axes + a)] -
                                 position[static_cast<std::size_t>(a)],
                             2);
        }
        if (square < least) {
          least = square;
          best = c;
        }
      }
      EXPECT_EQ(niches.niche_of(position), best);
      met.insert(best);
    }
    EXPECT_EQ(met.size(), 30u);
  }
}

// The mean squared distance to the nearest of n centres is at least 1 / (2 pi n), that within discs
// of the area 1 / n; for centres drawn at random it is twice that, 1 / (pi n), and more at borders.
TEST(Niches, CentresAreSpread) {
  const int n = 100, samples = 20000;
  const Niches niches = Niches::centroidal(n, 2, 1);
  RandomStream stream = test_stream(34);
  double sum = 0;
  for (int i = 0; i < samples; ++i) {
    const std::vector<double> position = {stream.uniform(), stream.uniform()};
    const auto c = static_cast<std::size_t>(niches.niche_of(position));
    sum += std::pow(niches.centres()[2 * c] - position[0], 2) +
           std::pow(niches.centres()[2 * c + 1] - position[1], 2);
  }
  const double disc = 1 / (2 * std::acos(-1.0) * n);
  EXPECT_GT(sum / samples, disc * 0.98);  // 20000 samples: 0.5 % of noise
  EXPECT_LT(sum / samples, disc * 1.25);
}

}  // namespace
}  // namespace metamorph::evolve
