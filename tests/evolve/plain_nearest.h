#pragma once

#include <cmath>
#include <cstddef>

namespace metamorph::evolve::plain {

/// Mean Euclidean distance from a query to its k nearest points (eq 8), over all of them if there
/// are fewer than k, -1 if there is none. points: coordinate d of point i at points[d * stride +
/// i]. excluded: index of a point to leave out, or -1. taken: scratch, [count]. One search over all
/// points per neighbour.
inline double mean_nearest(const double* points, std::ptrdiff_t stride, std::ptrdiff_t count,
                           int dimensions, const double* query, std::ptrdiff_t excluded, int k,
                           bool* taken) {
  for (std::ptrdiff_t i = 0; i < count; ++i) taken[i] = i == excluded;
  double sum = 0;
  int found = 0;
  for (; found < k; ++found) {
    std::ptrdiff_t nearest = -1;
    double least = 0;
    for (std::ptrdiff_t i = 0; i < count; ++i) {
      if (taken[i]) continue;
      double square = 0;
      for (int d = 0; d < dimensions; ++d) {
        const double difference = points[d * stride + i] - query[d];
        square += difference * difference;
      }
      if (nearest < 0 || square < least) {
        nearest = i;
        least = square;
      }
    }
    if (nearest < 0) break;
    taken[nearest] = true;
    sum += std::sqrt(least);
  }
  return found > 0 ? sum / found : -1;
}

}  // namespace metamorph::evolve::plain
