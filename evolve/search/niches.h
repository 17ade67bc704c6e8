#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace metamorph::evolve {

/// A cut of the unit cube into niches: a grid of bins, or the cells of centres that are spread
/// evenly (CVT). Whoever stands outside the cube belongs to the nearest niche of its border.
class Niches {
 public:
  /// A grid: [axes] bins of equal width along each axis, the last axis running fastest.
  static Niches grid(std::vector<int> bins);
  /// `count` centres, by k-means on random samples of the cube: the same ones in every run, for any
  /// number of threads.
  static Niches centroidal(int count, int axes, int threads);

  int count() const { return count_; }
  /// Niche of a position, [axes]; of equally near centres the first.
  int niche_of(std::span<const double> position) const;
  /// [count * axes] a centre after the other; empty for a grid.
  const std::vector<double>& centres() const { return centres_; }

 private:
  std::vector<int> bins_;        ///< [axes]; empty if there are centres
  std::vector<double> centres_;  ///< [count * axes]
  int axes_ = 0;
  int count_ = 1;
};

}  // namespace metamorph::evolve
