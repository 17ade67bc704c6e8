#pragma once

// How different colours look, to those who have three kinds of cones and to those who lack one.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "evolve/view/colour.h"

namespace metamorph::tests {

using Triple = std::array<double, 3>;

enum class Vision { normal, protanopia, deuteranopia, tritanopia };
inline constexpr std::array all_visions = {Vision::normal, Vision::protanopia, Vision::deuteranopia,
                                           Vision::tritanopia};
inline const char* name(Vision vision) {
  constexpr std::array names = {"normal vision", "protanopia", "deuteranopia", "tritanopia"};
  return names[static_cast<std::size_t>(vision)];
}

inline Triple linear_rgb(const evolve::Colour& colour) {
  const auto linear = [](double v) {
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  };
  return {linear(colour.red), linear(colour.green), linear(colour.blue)};
}

/// What is left of a colour (linear RGB): Machado, Oliveira and Fernandes, A physiologically-based
/// model for simulation of color vision deficiency (2009), severity 1.0.
inline Triple as_seen(const Triple& rgb, Vision vision) {
  using Matrix = std::array<Triple, 3>;
  static constexpr std::array<Matrix, 4> matrices = {Matrix{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
                                                     Matrix{{{0.152286, 1.052583, -0.204868},
                                                             {0.114503, 0.786281, 0.099216},
                                                             {-0.003882, -0.048116, 1.051998}}},
                                                     Matrix{{{0.367322, 0.860646, -0.227968},
                                                             {0.280085, 0.672501, 0.047413},
                                                             {-0.011820, 0.042940, 0.968881}}},
                                                     Matrix{{{1.255528, -0.076749, -0.178779},
                                                             {-0.078411, 0.930809, 0.147602},
                                                             {0.004733, 0.691367, 0.303900}}}};
  const Matrix& matrix = matrices[static_cast<std::size_t>(vision)];
  Triple seen{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) seen[i] += matrix[i][j] * rgb[j];
    seen[i] = std::clamp(seen[i], 0.0, 1.0);
  }
  return seen;
}

/// CIE L*, a*, b* of linear sRGB, white D65.
inline Triple lab(const Triple& rgb) {
  const auto f = [](double t) {
    return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116;
  };
  const auto& [r, g, b] = rgb;
  const double x = f((0.4124564 * r + 0.3575761 * g + 0.1804375 * b) / 0.95047);
  const double y = f(0.2126729 * r + 0.7151522 * g + 0.0721750 * b);
  const double z = f((0.0193339 * r + 0.1191920 * g + 0.9503041 * b) / 1.08883);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

/// CIEDE2000, as Sharma, Wu and Dalal (2005) write it, of two colours in CIE L*a*b*.
inline double ciede2000(const Triple& one, const Triple& two) {
  constexpr double degree = std::numbers::pi / 180, turn = 2 * std::numbers::pi;
  const auto share = [](double chroma) {
    const double seventh = std::pow(chroma, 7);
    return std::sqrt(seventh / (seventh + std::pow(25.0, 7)));
  };
  const double stretch =
      1 + 0.5 * (1 - share((std::hypot(one[1], one[2]) + std::hypot(two[1], two[2])) / 2));
  const double chroma1 = std::hypot(stretch * one[1], one[2]);
  const double chroma2 = std::hypot(stretch * two[1], two[2]);
  const auto hue = [&](const Triple& c) {
    const double angle = std::atan2(c[2], stretch * c[1]);
    return angle < 0 ? angle + turn : angle;
  };
  const double hue1 = hue(one), hue2 = hue(two);
  const bool grey = chroma1 * chroma2 == 0;
  const bool far = std::abs(hue1 - hue2) > turn / 2;
  double hue_step = 0, mean_hue = hue1 + hue2;
  if (!grey) {
    hue_step = hue2 - hue1;
    if (far) hue_step += hue_step > 0 ? -turn : turn;
    if (far) mean_hue += mean_hue < turn ? turn : -turn;
    mean_hue /= 2;
  }
  const double lightness_step = two[0] - one[0], chroma_step = chroma2 - chroma1;
  const double hue_length = 2 * std::sqrt(chroma1 * chroma2) * std::sin(hue_step / 2);
  const double mean_chroma = (chroma1 + chroma2) / 2;
  const double from_middle = std::pow((one[0] + two[0]) / 2 - 50, 2);
  const double t = 1 - 0.17 * std::cos(mean_hue - 30 * degree) + 0.24 * std::cos(2 * mean_hue) +
                   0.32 * std::cos(3 * mean_hue + 6 * degree) -
                   0.20 * std::cos(4 * mean_hue - 63 * degree);
  const double rotation = 30 * degree * std::exp(-std::pow((mean_hue / degree - 275) / 25, 2));
  const double l = lightness_step / (1 + 0.015 * from_middle / std::sqrt(20 + from_middle));
  const double c = chroma_step / (1 + 0.045 * mean_chroma);
  const double h = hue_length / (1 + 0.015 * mean_chroma * t);
  return std::sqrt(l * l + c * c + h * h - std::sin(2 * rotation) * 2 * share(mean_chroma) * c * h);
}

inline double difference(const evolve::Colour& one, const evolve::Colour& two, Vision vision) {
  return ciede2000(lab(as_seen(linear_rgb(one), vision)), lab(as_seen(linear_rgb(two), vision)));
}

}  // namespace metamorph::tests
