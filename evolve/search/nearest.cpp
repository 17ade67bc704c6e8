#include "evolve/search/nearest.h"

#include <cstddef>
#include <vector>

#include "core/body/parallel_for.h"
#include "evolve/search/nearest_squared.h"

namespace metamorph::evolve {

void mean_nearest_distances(std::span<const double> points, int dimensions, int k, int threads,
                            std::span<double> mean) {
  const std::ptrdiff_t count = static_cast<std::ptrdiff_t>(points.size()) / dimensions;
  struct Scratch {
    std::vector<double> query, smallest;
  };
  core::parallel_for<core::Schedule::equal>(
      mean.size(), threads,
      [&] {
        return Scratch{std::vector<double>(static_cast<std::size_t>(dimensions)),
                       std::vector<double>(static_cast<std::size_t>(k))};
      },
      [&](Scratch& scratch, std::size_t index) {
        const auto q = static_cast<std::ptrdiff_t>(index);
        for (int d = 0; d < dimensions; ++d) {
          scratch.query[static_cast<std::size_t>(d)] =
              points[static_cast<std::size_t>(d * count + q)];
        }
        mean[index] = mean_nearest(points.data(), count, count, dimensions, scratch.query.data(), q,
                                   k, scratch.smallest.data());
      });
}

}  // namespace metamorph::evolve
