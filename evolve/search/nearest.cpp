#include "evolve/search/nearest.h"

#include <cstddef>
#include <vector>

#include "evolve/search/nearest_squared.h"

namespace metamorph::evolve {

void mean_nearest_distances(std::span<const double> points, int dimensions, int k, int threads,
                            std::span<double> mean) {
  const std::ptrdiff_t count = static_cast<std::ptrdiff_t>(points.size()) / dimensions;
  const std::ptrdiff_t queries = static_cast<std::ptrdiff_t>(mean.size());
#pragma omp parallel num_threads(threads)
  {
    std::vector<double> query(static_cast<std::size_t>(dimensions));
    std::vector<double> smallest(static_cast<std::size_t>(k));
#pragma omp for schedule(static)
    for (std::ptrdiff_t q = 0; q < queries; ++q) {
      for (int d = 0; d < dimensions; ++d) {
        query[static_cast<std::size_t>(d)] = points[static_cast<std::size_t>(d * count + q)];
      }
      mean[static_cast<std::size_t>(q)] = mean_nearest(points.data(), count, count, dimensions,
                                                       query.data(), q, k, smallest.data());
    }
  }
}

}  // namespace metamorph::evolve
