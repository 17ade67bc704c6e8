#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "metamorph/searches.h"

namespace metamorph::evolve {

/// A descriptor of the problem that a search spreads individuals along.
struct Axis {
  std::string name;
  std::size_t descriptor = 0;  ///< of the problem
  double low = 0, high = 1;    ///< the ends; whoever is beyond stands beyond
};

/// The keys that choose axes and cut them into niches, the same for every search that has them.
std::vector<Setting> axis_settings();

/// What they contradict. Beyond it nothing here or in niches.h can go wrong.
std::vector<Contradiction> axis_faults(const SearchSetup& setup);

/// Precondition, here and below: no faults.
std::vector<Axis> axes_of(const SearchSetup& setup);

/// [axes] where an individual stands, 0 at the low end of an axis and 1 at the high one, not
/// clamped; empty if it has no behaviour.
std::vector<double> position_on(const std::vector<Axis>& axes, const Evaluation& evaluation);

/// Bins of every axis, [axes].
std::vector<int> bins_of(const SearchSetup& setup);

}  // namespace metamorph::evolve
