// Colours that a picture asks to be told apart are told apart by the colour-blind.

#include "tests/evolve/colour_vision.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace metamorph::evolve {
namespace {

using tests::Triple;
using tests::Vision;

// Of marks a third of a degree wide, about a cell of a printed figure, half of all people notice a
// step of 7.3 along L*, 10.0 along a* and 14.0 along b* (Stone, Szafir and Setlur, An engineering
// model for color difference as a function of size, 2014). CIEDE2000 shortens steps along a* and
// b*, so 15 asks more than that in every direction.
constexpr double noticed = 15;

struct Pair {
  std::string name;
  Colour one, two;
};

/// Every pair of a palette.
std::vector<Pair> pairs_of(const std::string& name, const std::vector<Colour>& palette) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < palette.size(); ++i) {
    for (std::size_t j = i + 1; j < palette.size(); ++j) {
      pairs.push_back({fmt::format("{} {} and {}", name, i, j), palette[i], palette[j]});
    }
  }
  return pairs;
}

void expect_told_apart(const std::vector<Pair>& pairs) {
  for (const auto& [name, one, two] : pairs) {
    for (const Vision vision : tests::all_visions) {
      EXPECT_GE(tests::difference(one, two, vision), noticed)
          << name << ", " << tests::name(vision);
    }
  }
}

TEST(ColourVision, StrainIsToldApart) {
  expect_told_apart(pairs_of("contracted, rest, expanded",
                             {strain_colour(0.6), strain_colour(1), strain_colour(1.4)}));
  expect_told_apart(pairs_of("half contracted, rest, half expanded",
                             {strain_colour(0.8), strain_colour(1), strain_colour(1.2)}));
}

TEST(ColourVision, StagesOfBirthAreToldApart) {
  std::vector<Colour> drawn, pure;
  for (int stage = 0; stage < 5; ++stage) {
    pure.push_back(birth_colour(stage));
    drawn.push_back(mix(birth_colour(stage), colours::paper, 0.25));  // as panels fill with it
  }
  expect_told_apart(pairs_of("stages", pure));
  drawn.push_back(colours::paper);
  expect_told_apart(pairs_of("stages as drawn, and paper,", drawn));
}

TEST(ColourVision, ContactsAreToldApart) {
  expect_told_apart(pairs_of("touches nothing, the ground, itself",
                             {contact_colour(Contact::none), contact_colour(Contact::ground),
                              contact_colour(Contact::itself)}));
}

TEST(ColourVision, PhasesAQuarterApartAreToldApart) {
  constexpr double quarter = std::numbers::pi / 2;
  for (int k = 0; k < 32; ++k) {
    const double phase = quarter * k / 32;
    expect_told_apart(
        pairs_of(fmt::format("phase {:.2f} and quarters on,", phase),
                 {phase_colour(phase), phase_colour(phase + quarter),
                  phase_colour(phase + 2 * quarter), phase_colour(phase + 3 * quarter)}));
  }
}

// The measure itself, by what is known of it.

TEST(ColourVision, DifferencesAreThoseOfThePublishedPairs) {
  struct Known {
    Triple one, two;
    double difference;
  };
  // Pairs 1, 5, 9, 17, 19, 25 and 34 of table 1 of Sharma, Wu and Dalal (2005).
  for (const auto& [one, two, known] :
       {Known{{50, 2.6772, -79.7751}, {50, 0, -82.7485}, 2.0425},
        Known{{50, -1.1848, -84.8006}, {50, 0, -82.7485}, 1.0000},
        Known{{50, 2.49, -0.001}, {50, -2.49, 0.0009}, 7.1792},
        Known{{50, 2.5, 0}, {73, 25, -18}, 27.1492}, Known{{50, 2.5, 0}, {56, -27, -3}, 31.9030},
        Known{{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644},
        Known{{2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514}, 0.9082}}) {
    EXPECT_NEAR(tests::ciede2000(one, two), known, 5e-5);
    EXPECT_NEAR(tests::ciede2000(two, one), known, 5e-5);
  }
}

TEST(ColourVision, RedAndGreenOfOneLightnessAreLostToThoseWithoutRedOrGreenCones) {
  const Colour red{0.76, 0.45, 0.38}, green{0.52, 0.56, 0.36};
  EXPECT_GT(tests::difference(red, green, Vision::normal), 2 * noticed);
  EXPECT_LT(tests::difference(red, green, Vision::deuteranopia), noticed / 2);
  EXPECT_GT(tests::difference(red, green, Vision::tritanopia), noticed);
  for (const Vision vision : tests::all_visions) {  // greys stay grey
    EXPECT_LT(tests::difference({0.5, 0.5, 0.5}, {0.5, 0.5, 0.51}, vision), 2);
    EXPECT_EQ(tests::difference(colours::ink, colours::ink, vision), 0);
  }
}

}  // namespace
}  // namespace metamorph::evolve
