#pragma once

#include <string>
#include <vector>

namespace metamorph::evolve {

/// Where an axis has its marks: round numbers, 1, 2 or 5 times a power of ten apart.
struct Ticks {
  double step = 1;
  double first = 0, last = 1;  ///< the marks are at these whole multiples of step

  double low() const { return first * step; }
  double high() const { return last * step; }
  std::vector<double> values() const;
  /// As many digits after the point as the marks need.
  std::string label(double value) const;
};

/// Ticks from the last mark at or below `low` to the first at or above `high`, `most` + 1 of them
/// at most; of whole numbers where `whole`. Precondition: below 1e100 in magnitude, low <= high,
/// most >= 2.
Ticks ticks_around(double low, double high, int most, bool whole = false);

}  // namespace metamorph::evolve
