#include "evolve/view/axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace metamorph::evolve {
namespace {

// A mark that lies on a limit but for rounding is at it.
constexpr double slack = 1e-9;

/// The least 1, 2 or 5 times a power of ten that is above `step`.
double next_round(double step) {
  const double power = std::pow(10, std::floor(std::log10(step) + slack));
  for (const double round : {2 * power, 5 * power}) {
    if (round > step * (1 + slack)) return round;
  }
  return 10 * power;
}

}  // namespace

std::vector<double> Ticks::values() const {
  std::vector<double> result;
  for (double i = first; i <= last; ++i) result.push_back(i * step);
  return result;
}

std::string Ticks::label(double value) const {
  if (step >= 1e6 || step < 1e-4) return fmt::format("{:g}", value);
  const int digits = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - slack)));
  return fmt::format("{:.{}f}", value, digits);
}

Ticks ticks_around(double low, double high, int most, bool whole) {
  // Less apart than numbers of this size can be divided: shown as one value.
  if (high - low <= 1e-12 * std::max(std::abs(low), std::abs(high))) {
    high = low + (low == 0 ? 1 : std::abs(low));
  }
  double step = std::pow(10, std::floor(std::log10((high - low) / most)));
  if (whole) step = std::max(step, 1.0);
  for (;; step = next_round(step)) {
    const double first = std::floor(low / step + slack), last = std::ceil(high / step - slack);
    if (last - first <= most) return {step, first, last};
  }
}

}  // namespace metamorph::evolve
