#pragma once

// What pictures, films and their frames draw of a body's mesh. `points` are its nodes on the
// canvas.

#include <array>
#include <span>
#include <vector>

#include "evolve/view/canvas.h"
#include "metamorph/body.h"

namespace metamorph::evolve {

/// Fills every triangle, shared out among its corners by its medians, so that each cell shows its
/// own colour around its node. `colours` [nodes].
void fill_cells(Canvas& canvas, const core::Body& body, std::span<const Point> points,
                std::span<const Colour> colours);

/// Fills every triangle in the colour of S/S0. `unit`: a d on the canvas.
void fill_areas(Canvas& canvas, const core::Body& body, std::span<const Point> points,
                double unit = 1);

/// Lines for Canvas::stroke_lines().
std::vector<std::array<Point, 2>> segments_of(std::span<const std::array<core::Index, 2>> edges,
                                              std::span<const Point> points);

}  // namespace metamorph::evolve
