#pragma once

#include <span>
#include <vector>

// What a collection of individuals is worth, for any search.

namespace metamorph::evolve {

/// What a map is worth whose niches hold the best individual that was found for each.
struct MapWorth {
  int filled = 0;       ///< niches that hold somebody
  double coverage = 0;  ///< filled / niches
  double qd_score = 0;  ///< sum over the filled niches of (quality - offset)
  double best = 0;      ///< quality; 0 if nothing is filled
  double mean = 0;      ///< quality of the filled niches; 0 if there is none
};

/// `qualities` of the filled niches, in order of their niches (the sums are formed in that order),
/// out of `niches` > 0. The offset is a quality that nobody falls below, so that filling a niche
/// never lowers the score: 0 here, where distances are never negative.
MapWorth map_worth(std::span<const double> qualities, int niches, double offset = 0);

/// The volume that points dominate: of the union of the boxes between each point and the reference,
/// more being better in every coordinate. A point that is not above the reference in all of them
/// adds nothing. Exact for any number of coordinates, at least one; 300 points of two cost nothing,
/// of four some tenths of a second. points: [points][coordinates].
double hypervolume(const std::vector<std::vector<double>>& points,
                   std::span<const double> reference);

}  // namespace metamorph::evolve
