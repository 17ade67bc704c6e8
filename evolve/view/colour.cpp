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

Colour curve_colour(int number) {
  constexpr Colour palette[curve_colours] = {{0.000, 0.447, 0.698},   // blue
                                             {0.835, 0.369, 0.000},   // vermillion
                                             {0.000, 0.620, 0.451},   // bluish green
                                             {0.800, 0.475, 0.655},   // reddish purple
                                             {0.902, 0.624, 0.000},   // orange
                                             {0.337, 0.706, 0.914}};  // sky blue
  return palette[number % curve_colours];
}

Colour mix(const Colour& a, const Colour& b, double t) {
  return {std::lerp(a.red, b.red, t), std::lerp(a.green, b.green, t), std::lerp(a.blue, b.blue, t),
          std::lerp(a.alpha, b.alpha, t)};
}

Colour pale(const Colour& colour) { return mix(colour, colours::paper, 0.25); }

Colour strain_colour(double area_ratio, double range) {
  const double strain = std::clamp((area_ratio - 1) / range, -1.0, 1.0);
  const Colour& end = strain < 0 ? colours::contracted : colours::expanded;
  return mix(colours::paper, end, std::abs(strain));
}

Colour sequential_colour(double t) {
  constexpr Colour stops[] = {{0.000, 0.135, 0.305},
                              {0.266, 0.306, 0.424},
                              {0.490, 0.486, 0.471},
                              {0.737, 0.687, 0.433},
                              {0.996, 0.909, 0.217}};
  constexpr int pieces = static_cast<int>(std::size(stops)) - 1;
  const double place = std::clamp(t, 0.0, 1.0) * pieces;
  const auto piece = static_cast<std::size_t>(std::min(static_cast<int>(place), pieces - 1));
  return mix(stops[piece], stops[piece + 1], place - static_cast<double>(piece));
}

Colour contact_colour(Contact contact) {
  switch (contact) {
    case Contact::ground:
      return {0.76, 0.34, 0.02};
    case Contact::itself:
      return {0.34, 0.25, 0.62};
    case Contact::none:
      break;
  }
  return {0.86, 0.87, 0.88};
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
