#include "evolve/search/nearest_squared.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "metamorph/random.h"
#include "tests/evolve/plain_nearest.h"

namespace metamorph::evolve {
namespace {

struct Cloud {
  std::ptrdiff_t stride, count;
  int dimensions;
  std::vector<double> points;
};

// Coordinates in whole numbers over 4 where `coarse`: many points coincide or tie. The unused end
// of each row holds what would show if it were read.
Cloud random_cloud(std::ptrdiff_t count, int dimensions, bool coarse, RandomStream& stream) {
  Cloud cloud{count + 3, count, dimensions, {}};
  cloud.points.assign(static_cast<std::size_t>(cloud.stride * dimensions),
                      std::numeric_limits<double>::quiet_NaN());
  for (int d = 0; d < dimensions; ++d) {
    for (std::ptrdiff_t i = 0; i < count; ++i) {
      const double x = 8 * stream.triangular();
      cloud.points[static_cast<std::size_t>(d * cloud.stride + i)] =
          coarse ? std::round(4 * x) / 4 : x;
    }
  }
  return cloud;
}

std::vector<double> point(const Cloud& cloud, std::ptrdiff_t i) {
  std::vector<double> coordinates;
  for (int d = 0; d < cloud.dimensions; ++d) {
    coordinates.push_back(cloud.points[static_cast<std::size_t>(d * cloud.stride + i)]);
  }
  return coordinates;
}

double fast(const Cloud& cloud, const std::vector<double>& query, std::ptrdiff_t excluded, int k) {
  std::vector<double> smallest(static_cast<std::size_t>(k));
  return mean_nearest(cloud.points.data(), cloud.stride, cloud.count, cloud.dimensions,
                      query.data(), excluded, k, smallest.data());
}

double plain(const Cloud& cloud, const std::vector<double>& query, std::ptrdiff_t excluded, int k) {
  const std::unique_ptr<bool[]> taken(new bool[static_cast<std::size_t>(cloud.count)]);
  return plain::mean_nearest(cloud.points.data(), cloud.stride, cloud.count, cloud.dimensions,
                             query.data(), excluded, k, taken.get());
}

TEST(Nearest, EqualsTheReferenceBitForBit) {
  // Both add squares in order of the coordinates and distances from the nearest on.
  RandomStream stream(Purpose::test, 1, 0, 0);
  for (const int count : {1, 2, 15, 16, 17, 127, 128, 129, 300, 1001}) {
    for (const int dimensions : {1, 2, 4}) {
      const Cloud cloud = random_cloud(count, dimensions, count % 2 == 0, stream);
      for (const int k : {1, 2, 15, 40}) {
        for (const std::ptrdiff_t excluded :
             {std::ptrdiff_t{-1}, std::ptrdiff_t{0}, cloud.count - 1}) {
          const std::vector<double> query = point(cloud, count / 2);
          ASSERT_EQ(fast(cloud, query, excluded, k), plain(cloud, query, excluded, k))
              << count << ' ' << dimensions << ' ' << k << ' ' << excluded;
        }
      }
    }
  }
}

TEST(Nearest, FindsThePointsInOrder) {
  const std::vector<double> xs = {5, -1, 3, 0, 2, 2};
  std::vector<double> smallest(7);
  const double query = 0;
  EXPECT_EQ(nearest_squared(xs.data(), 6, 6, 1, &query, std::ptrdiff_t{3}, 3, smallest.data()), 3);
  EXPECT_EQ((std::vector<double>(smallest.begin(), smallest.begin() + 3)),
            (std::vector<double>{1, 4, 4}));
  EXPECT_EQ(nearest_squared(xs.data(), 6, 6, 1, &query, std::ptrdiff_t{-1}, 7, smallest.data()), 6);
  EXPECT_EQ(smallest,
            (std::vector<double>{0, 1, 4, 4, 9, 25, std::numeric_limits<double>::infinity()}));
}

TEST(Nearest, DoesNotDependOnTheOrderOfThePoints) {
  RandomStream stream(Purpose::test, 2, 0, 0);
  Cloud cloud = random_cloud(500, 4, true, stream);
  const std::vector<double> query = point(cloud, 17);
  const double before = fast(cloud, query, -1, 15);
  for (int d = 0; d < 4; ++d) {
    const auto row = cloud.points.begin() + d * cloud.stride;
    std::rotate(row, row + 123, row + cloud.count);
  }
  EXPECT_EQ(fast(cloud, query, -1, 15), before);
}

TEST(Nearest, NothingButTheQueryItself) {
  const double x = 3;
  double smallest = 0;
  EXPECT_EQ(mean_nearest(&x, 1, 1, 1, &x, std::ptrdiff_t{0}, 1, &smallest), -1);
  EXPECT_EQ(mean_nearest(&x, 1, 0, 1, &x, std::ptrdiff_t{-1}, 1, &smallest), -1);
  EXPECT_EQ(mean_nearest(&x, 1, 1, 1, &x, std::ptrdiff_t{-1}, 1, &smallest), 0);
}

TEST(Nearest, InSinglePrecision) {
  RandomStream stream(Purpose::test, 3, 0, 0);
  const Cloud cloud = random_cloud(400, 4, false, stream);
  const std::vector<float> points(cloud.points.begin(), cloud.points.end());
  for (std::ptrdiff_t q = 0; q < 20; ++q) {
    const std::vector<double> query = point(cloud, q);
    const std::vector<float> single(query.begin(), query.end());
    std::vector<float> smallest(15);
    const float mean = mean_nearest(points.data(), cloud.stride, cloud.count, 4, single.data(), q,
                                    15, smallest.data());
    // Coordinates below 8 are off by at most 8 * 2^-24 each, hence a distance by at most
    // 2 * 2 * 8 * 2^-24; the arithmetic's own rounding is of the same size.
    EXPECT_NEAR(mean, plain(cloud, query, q, 15), 1e-5);
  }
}

}  // namespace
}  // namespace metamorph::evolve
