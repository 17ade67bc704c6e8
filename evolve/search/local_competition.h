#pragma once

#include <cstdint>
#include <span>
#include <vector>

// Comparisons of individuals with those that are like them.

namespace metamorph::evolve {

/// An individual among others: who, where it stands, how good it is. All positions are of one
/// length and finite.
struct Placed {
  std::int64_t id = 0;
  std::vector<double> position;
  double quality = 0;
};

/// An individual among its k nearest, itself left out wherever it stands. Of equally distant ones
/// the first in the list is nearer. With fewer than k others: all of them.
struct Neighbourhood {
  double novelty = 0;  ///< mean Euclidean distance (eq 8); 0 if there is nobody
  int worse = 0;       ///< how many are of lower quality
};

/// Of the first `queries` of `all`, among all. The same bits for any number of threads.
std::vector<Neighbourhood> neighbourhoods(std::span<const Placed> all, std::size_t queries, int k,
                                          int threads);

/// [all] mean Euclidean distance to the k nearest that are fitter: of higher quality, or of the
/// same and earlier in the list, so that a copy gains nothing. With fewer than k: to all of them;
/// infinite for the fittest. The same bits for any number of threads.
std::vector<double> distances_to_fitter(std::span<const Placed> all, int k, int threads);

}  // namespace metamorph::evolve
