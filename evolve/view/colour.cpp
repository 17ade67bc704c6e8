#include "evolve/view/colour.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>

namespace metamorph::evolve {

Colour birth_colour(int stage) {
  constexpr Colour first{0.33, 0.58, 0.84};
  constexpr Colour later[] = {
      {0.88, 0.38, 0.33}, {0.99, 0.86, 0.30}, {0.03, 0.32, 0.00}, {0.37, 0.19, 0.73}};
  return stage <= 0 ? first : later[static_cast<std::size_t>(stage - 1) % std::size(later)];
}

Colour mix(const Colour& a, const Colour& b, double t) {
  return {std::lerp(a.red, b.red, t), std::lerp(a.green, b.green, t), std::lerp(a.blue, b.blue, t),
          std::lerp(a.alpha, b.alpha, t)};
}

Colour strain_colour(double area_ratio, double range) {
  const double strain = std::clamp((area_ratio - 1) / range, -1.0, 1.0);
  const Colour& end = strain < 0 ? colours::contracted : colours::expanded;
  return mix(colours::paper, end, std::abs(strain));
}

namespace {

double srgb(double linear) {
  const double v = std::clamp(linear, 0.0, 1.0);
  return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
}

}  // namespace

Colour phase_colour(double phase) {
  // A circle in Oklab (Ottosson 2020), tilted: one of even lightness would show those who lack a
  // kind of cone the same colour twice, for they see lightness and one more axis only. It is
  // highest half way between the axes of red and green and of yellow and blue, so that none loses
  // both.
  constexpr double middle = 0.70, tilt = 0.18, chroma = 0.11, lightest = std::numbers::pi * 5 / 6;
  const double lightness = middle + tilt * std::cos(phase - lightest);
  const double a = chroma * std::cos(phase), b = chroma * std::sin(phase);
  const double l = std::pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
  const double m = std::pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
  const double s = std::pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
  return {srgb(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          srgb(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          srgb(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

}  // namespace metamorph::evolve
