#include "metamorph/shape.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "core/body/area.h"
#include "core/body/limbs.h"
#include "core/body/symmetry.h"
#include "kernels/elementary.h"

namespace metamorph::core {
namespace {

double elongation_of(const SecondMoments& moments) {
  const double mean = 0.5 * (moments.xx + moments.yy), half = 0.5 * (moments.xx - moments.yy);
  const double larger = mean + std::sqrt(half * half + moments.xy * moments.xy);
  if (!(larger > 0)) return 0;
  // From the determinant: the difference of nearly equal numbers would be of no use.
  const double smaller = (moments.xx * moments.yy - moments.xy * moments.xy) / larger;
  return 1 - std::sqrt(std::clamp(smaller / larger, 0.0, 1.0));
}

double coherence_of(const std::vector<double>& phases) {
  double sine = 0, cosine = 0;
  for (const double phase : phases) {
    double s = 0, c = 0;
    const double half_turns = phase / std::numbers::pi;
    kernels::sin_cos_pi(half_turns - 2 * std::floor(0.5 * half_turns + 0.5), s, c);
    sine += s;
    cosine += c;
  }
  const double sum = std::sqrt(sine * sine + cosine * cosine);
  return std::min(1.0, sum / static_cast<double>(phases.size()));
}

}  // namespace

Shape shape_of(const Body& body) {
  assert(!body.triangles.empty());
  const auto outline = outline_of(body.triangles);
  const Area area = area_of(body);
  double around = 0;
  for (const auto& edge : outline) around += length(body, edge);
  double periods = 0;
  for (const double period : body.period) periods += period;

  Shape shape;
  shape.elongation = elongation_of(second_moments(body, area.centroid));
  shape.compactness = std::min(1.0, 4 * std::numbers::pi * area.size / (around * around));
  shape.symmetry = symmetry_of(body);
  shape.limbs = count_limbs(body, area, outline);
  shape.mean_period = periods / static_cast<double>(body.period.size());
  shape.phase_coherence = coherence_of(body.phase);
  return shape;
}

}  // namespace metamorph::core
