#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "evolve/view/canvas.h"

namespace metamorph::evolve {

/// Two quantities against each other: what tiles and points stand for is told by their colours.
struct Field {
  struct Tile {
    double left = 0, bottom = 0, right = 0, top = 0;
    Colour colour;
  };
  /// With `steps` a border falls from each to the next, around all that they dominate.
  struct Points {
    std::vector<Point> points;
    Colour colour;
    bool steps = false;
  };

  std::string heading, remark;
  std::string across, up;  ///< what the axes tell, with units
  Point low, high;         ///< ends of the axes; low < high
  std::vector<Tile> tiles;
  std::vector<Points> points;
  std::array<std::string, 3> strip;            ///< words below a strip of the colours
  std::function<Colour(double)> strip_colour;  ///< of 0 to 1
};

/// The picture as bytes of .svg, .png or .pdf, by the ending of `file`, which is not written.
/// Throws std::runtime_error if it cannot be drawn.
std::string draw_field(const Field& field, const std::string& file, double density);

}  // namespace metamorph::evolve
