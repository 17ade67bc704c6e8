#pragma once

namespace metamorph::evolve {

// What has to be told apart is told apart by those who lack a kind of cone, too
// (tests/evolve/colour_vision_test.cpp).

/// sRGB with opacity, each in [0, 1].
struct Colour {
  double red = 0, green = 0, blue = 0, alpha = 1;
  bool operator==(const Colour&) const = default;
};

namespace colours {
inline constexpr Colour ink{0.13, 0.15, 0.19};         ///< text, outlines
inline constexpr Colour faint_ink{0.42, 0.45, 0.50};   ///< captions, scale bar
inline constexpr Colour paper{1, 1, 1};                ///< background
inline constexpr Colour contracted{0.16, 0.38, 0.76};  ///< the end of the strain scale below 1
inline constexpr Colour expanded{0.83, 0.20, 0.18};    ///< the end of the strain scale above 1
inline constexpr Colour ground{0.55, 0.52, 0.46};
inline constexpr Colour grid{0.90, 0.91, 0.92};  ///< lines behind curves
}  // namespace colours

/// Of cells born in a stage of life, counted from 0: blue in the first, red in the metamorphosis to
/// the second (figure 4), then yellow, green and violet, and again from red on.
Colour birth_colour(int stage);

/// Colours that tell curves apart, also for the colour-blind (Okabe and Ito 2008; without black and
/// yellow, which are text and too light for a line), from the first again after the last.
inline constexpr int curve_colours = 6;
Colour curve_colour(int number);

/// (1 - t) a + t b in every channel; t in [0, 1].
Colour mix(const Colour& a, const Colour& b, double t);

/// As areas are filled, so that lines on them are seen.
Colour pale(const Colour& colour);

/// Colour of a triangle squeezed or stretched to `area_ratio` = S/S0: white at rest, blue
/// contracted, red expanded (figures 3, 6); saturated at 1 -+ `range`.
Colour strain_colour(double area_ratio, double range = 0.4);

/// From dark blue over grey to yellow as t goes from 0 to 1: lighter is more, for the colour-blind
/// too (cividis; Nunez, Anderton and Renslow 2018).
Colour sequential_colour(double t);

enum class Contact { none, ground, itself };
/// Light grey, dark orange, violet.
Colour contact_colour(Contact contact);

/// Colour of a phase shift in radians (figure 9): cyclic, lightest at 5/6 pi, darkest at -pi/6.
Colour phase_colour(double phase);

}  // namespace metamorph::evolve
