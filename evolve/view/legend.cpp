#include "evolve/view/legend.h"

#include <algorithm>

namespace metamorph::evolve {

void draw_strip(Canvas& canvas, Point at, const std::array<std::string, 3>& words, double size,
                const std::function<Colour(double)>& colour) {
  constexpr double length = strip_length, thickness = 10;
  constexpr int pieces = 90;
  for (int i = 0; i < pieces; ++i) {
    const double x = at.x + length * i / pieces;
    // Each piece reaches under the next one, so that no seam shows.
    const double end = std::min(at.x + length, x + 2 * length / pieces);
    const std::array piece{Point{x, at.y - 8}, Point{end, at.y - 8},
                           Point{end, at.y - 8 - thickness}, Point{x, at.y - 8 - thickness}};
    canvas.fill_polygon(piece, colour((i + 0.5) / pieces));
  }
  canvas.text({at.x, at.y + 6}, words[0], size, colours::faint_ink);
  canvas.text({at.x + length / 2, at.y + 6}, words[1], size, colours::faint_ink, Align::centre);
  canvas.text({at.x + length, at.y + 6}, words[2], size, colours::faint_ink, Align::right);
}

double draw_discs(Canvas& canvas, Point at, std::span<const Disc> discs, double size) {
  double x = at.x;
  for (const Disc& disc : discs) {
    canvas.fill_circle({x + 6, at.y - 4}, 6, disc.colour);
    canvas.stroke_circle({x + 6, at.y - 4}, 5.5, mix(disc.colour, colours::ink, 0.35), 1);
    canvas.text({x + 18, at.y}, disc.words, size, colours::faint_ink);
    x += 18 + text_width(disc.words, size) + 20;
  }
  return x - 20;
}

std::vector<Disc> birth_discs(int stages) {
  std::vector<Disc> discs;
  for (int stage = 0; stage < stages; ++stage) {
    std::string words = stage == 0    ? "larval cells"
                        : stages <= 2 ? "born in metamorphosis"
                                      : "born in metamorphosis " + std::to_string(stage);
    discs.push_back({pale(birth_colour(stage)), std::move(words)});
  }
  return discs;
}

}  // namespace metamorph::evolve
