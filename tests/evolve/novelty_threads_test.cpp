#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "evolve/search/novelty.h"
#include "tests/evolve/random_genomes.h"

namespace metamorph::evolve {
namespace {

using testing::test_stream;

// eq 8 by sorting all distances.
double brute_force(const std::vector<std::vector<double>>& points, std::size_t query, int k) {
  std::vector<double> distances;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i == query || points[i].empty()) continue;
    double square = 0;
    for (std::size_t d = 0; d < points[i].size(); ++d) {
      square += std::pow(points[i][d] - points[query][d], 2);
    }
    distances.push_back(std::sqrt(square));
  }
  std::sort(distances.begin(), distances.end());
  const std::size_t found = std::min(distances.size(), static_cast<std::size_t>(k));
  double sum = 0;
  for (std::size_t i = 0; i < found; ++i) sum += distances[i];
  return sum / static_cast<double>(found);
}

TEST(Novelty, AgreesWithBruteForceForAnyThreadCount) {
  evolve::RandomStream stream = test_stream(1);
  for (const std::size_t dimensions : {std::size_t{2}, std::size_t{4}}) {
    for (const std::size_t archived : {std::size_t{0}, std::size_t{5}, std::size_t{700}}) {
      std::vector<std::vector<double>> behaviours(60);
      const auto any = [&] {
        std::vector<double> point(dimensions);
        // On a grid in part, so that ties and coincident points occur.
        for (double& x : point) x = std::round(10 * stream.triangular()) / 2;
        return point;
      };
      for (std::size_t i = 0; i < behaviours.size(); ++i) {
        if (i % 7 != 3) behaviours[i] = any();
      }
      std::vector<ArchiveEntry> archive(archived);
      std::vector<std::vector<double>> all = behaviours;
      for (ArchiveEntry& entry : archive) {
        entry.behaviour = any();
        all.push_back(entry.behaviour);
      }
      for (const int k : {1, 15, 100}) {
        const std::vector<double> scores = novelty(behaviours, archive, k, 1, 1);
        EXPECT_EQ(scores, novelty(behaviours, archive, k, 1, 2));
        EXPECT_EQ(scores, novelty(behaviours, archive, k, 1, 5));
        for (std::size_t i = 0; i < behaviours.size(); ++i) {
          const double expected = behaviours[i].empty() ? 0 : brute_force(all, i, k);
          // At most 100 terms, summed in the same order; std::pow of 2 may round differently.
          ASSERT_NEAR(scores[i], expected, 1e-13 * (1 + expected));
        }
      }
    }
  }
}

}  // namespace
}  // namespace metamorph::evolve
