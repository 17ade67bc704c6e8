#pragma once

#include <span>
#include <string>
#include <vector>

#include "evolve/view/draw.h"

namespace metamorph::evolve {

/// One animat among others: a column of its stages, the earliest on top.
struct Exhibit {
  std::string title;
  std::vector<Stage> stages;
  std::vector<int> starts;  ///< the steps at which its stages after the first begin, ascending
};

/// What the colours of cells tell.
enum class CellColours { birth, phase };

struct ZooStyle {
  CellColours colours = CellColours::birth;
  bool moving = true;  ///< arrows in the direction of movement, distances, ground
  int columns = 8;     ///< animats side by side, at most
};

/// Animats side by side to one scale (figures 5, 7, 9, 19), in as many blocks of rows as their
/// number takes, each about as wide as the others. A stage without a body is an empty place that
/// says why.
Sheet zoo_sheet(std::span<const Exhibit> exhibits, const ZooStyle& style);

}  // namespace metamorph::evolve
