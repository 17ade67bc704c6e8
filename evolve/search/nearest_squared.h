#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace metamorph::evolve {

/// The k smallest squared Euclidean distances from a query to a set of points, ascending.
/// points: [dimensions][stride] flat, coordinate d of point i at points[d * stride + i], i < count.
/// query: [dimensions]. excluded: index of a point to leave out (the query itself), or -1.
/// smallest: [k], filled with infinity behind the returned number, min(k, points not left out).
/// Finite coordinates; k > 0. The values do not depend on the order of the points.
template <class Real>
int nearest_squared(const Real* points, std::ptrdiff_t stride, std::ptrdiff_t count, int dimensions,
                    const Real* query, std::ptrdiff_t excluded, int k, Real* smallest) {
  constexpr std::ptrdiff_t block = 128;
  constexpr Real infinity = std::numeric_limits<Real>::infinity();
  Real square[block];
  std::fill_n(smallest, k, infinity);
  int found = 0;
  for (std::ptrdiff_t begin = 0; begin < count; begin += block) {
    const std::ptrdiff_t size = std::min(block, count - begin);
    for (int d = 0; d < dimensions; ++d) {
      const Real* const coordinate = points + d * stride + begin;
      const Real centre = query[d];
      if (d == 0) {
#pragma omp simd
        for (std::ptrdiff_t i = 0; i < size; ++i) {
          const Real difference = coordinate[i] - centre;
          square[i] = difference * difference;
        }
      } else {
#pragma omp simd
        for (std::ptrdiff_t i = 0; i < size; ++i) {
          const Real difference = coordinate[i] - centre;
          square[i] += difference * difference;
        }
      }
    }
    if (excluded >= begin && excluded < begin + size) square[excluded - begin] = infinity;
    // Only few points of a block are nearer than the k found so far; most blocks have none, and
    // that is decided without a branch per point.
    constexpr std::ptrdiff_t group = 16;
    for (std::ptrdiff_t g = 0; g < size; g += group) {
      const std::ptrdiff_t end = std::min(size, g + group);
      const Real limit = smallest[k - 1];
      int any = 0;
#pragma omp simd reduction(| : any)
      for (std::ptrdiff_t i = g; i < end; ++i) any |= square[i] < limit;
      if (any == 0) continue;
      for (std::ptrdiff_t i = g; i < end; ++i) {
        if (!(square[i] < smallest[k - 1])) continue;
        int at = k - 1;
        for (; at > 0 && smallest[at - 1] > square[i]; --at) smallest[at] = smallest[at - 1];
        smallest[at] = square[i];
        found = std::min(found + 1, k);
      }
    }
  }
  return found;
}

/// Mean distance from a query to its k nearest points, summed from the nearest on (eq 8); over all
/// points if there are fewer than k, -1 if there is none. Arguments as nearest_squared(); smallest
/// is scratch, [k].
template <class Real>
Real mean_nearest(const Real* points, std::ptrdiff_t stride, std::ptrdiff_t count, int dimensions,
                  const Real* query, std::ptrdiff_t excluded, int k, Real* smallest) {
  const int found =
      nearest_squared(points, stride, count, dimensions, query, excluded, k, smallest);
  if (found == 0) return -1;
  Real sum = 0;
  for (int i = 0; i < found; ++i) sum += std::sqrt(smallest[i]);
  return sum / static_cast<Real>(found);
}

}  // namespace metamorph::evolve
