#pragma once

#include <array>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "evolve/view/canvas.h"

namespace metamorph::evolve {

// What colours mean, in one line whose base is at `at`, in layout pixels.

/// Width of a strip.
inline constexpr double strip_length = 230;

/// A strip of colours with words below its ends and its middle; `colour` of t from 0 to 1.
void draw_strip(Canvas& canvas, Point at, const std::array<std::string, 3>& words, double size,
                const std::function<Colour(double)>& colour);

struct Disc {
  Colour colour;
  std::string words;
};

/// Discs with words beside them; returns where they end.
double draw_discs(Canvas& canvas, Point at, std::span<const Disc> discs, double size);

/// Discs for the stages of life that cells are born in.
std::vector<Disc> birth_discs(int stages);

}  // namespace metamorph::evolve
