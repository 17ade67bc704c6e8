#pragma once

#include <span>

namespace metamorph::evolve {

/// Mean Euclidean distance of points to their k nearest among all points (eq 8), each query left
/// out of its own neighbours. points: [dimensions][count] flat, coordinate d of point i at
/// points[d * count + i]; finite. The first mean.size() points are the queries. With fewer than k
/// others the mean is over all of them; with none it is -1. k > 0. The same bits for any number of
/// threads.
void mean_nearest_distances(std::span<const double> points, int dimensions, int k, int threads,
                            std::span<double> mean);

}  // namespace metamorph::evolve
