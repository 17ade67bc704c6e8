#pragma once

#include <cstddef>
#include <span>
#include <vector>

// Selection by several objectives at once (NSGA-II, Deb et al. 2002). More is better in each.

namespace metamorph::evolve {

/// [points] the front of each: 0 if nobody dominates it, else one more than the highest front of
/// those who do. Somebody dominates who is at least as good in every objective and better in one,
/// or equal in all and earlier in the list: of equal ones only the first counts in full.
std::vector<int> front_numbers(std::span<const std::vector<double>> points);

/// [members] crowding distance of the points of one front, given by their indices: the sum over the
/// objectives of the gap between the two neighbours, relative to the range of the front; infinite
/// at both ends of an objective. An objective in which all are equal says nothing.
std::vector<double> crowding_distances(std::span<const std::vector<double>> points,
                                       std::span<const std::size_t> members);

struct Ranking {
  std::vector<std::size_t> order;  ///< [points] best first: by front, then less crowded, then first
  std::vector<int> front;          ///< [points]
  std::vector<double> crowding;    ///< [points]
};

Ranking rank(std::span<const std::vector<double>> points);

}  // namespace metamorph::evolve
