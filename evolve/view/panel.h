#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "evolve/view/canvas.h"
#include "metamorph/body.h"
#include "metamorph/development.h"

namespace metamorph::evolve {

/// The part of the plane a drawing covers, in d. Empty until something is included.
struct Box {
  double left = 0, bottom = 0, right = 0, top = 0;
  bool empty = true;

  double width() const { return right - left; }
  double height() const { return top - bottom; }
  void include(Point point, double margin = 0);
};

/// One drawing of a sheet: draws itself in d, y up, inside its box.
struct Panel {
  std::string title;
  std::string caption;
  Box box;
  /// `pixel` is the size of a layout pixel in d, for lines that must not vanish.
  std::function<void(Canvas&, double pixel)> draw;
};

/// In which stage of life the cells of a body's nodes were born, from 0. Empty: nothing is known,
/// all are drawn as those of the first.
using BirthStages = std::vector<int>;  // [nodes]

/// The stage in which something was born: how many of `starts`, the steps at which the stages after
/// the first begin (ascending), it did not come before.
int birth_stage(int birth_step, std::span<const int> starts);

/// The same of every node of `body`; Body::cell says which cell of `embryo` a node is.
BirthStages birth_stages(const core::Body& body, const core::Embryo& embryo,
                         std::span<const int> starts);

/// Cells as disks, in the colour of the stage they were born in, and their links (figure 4, upper
/// rows). `starts` as in birth_stage().
Panel embryo_panel(const core::Embryo& embryo, std::span<const int> starts);

/// A body at rest: each cell's share of its triangles in its colour, springs, outline, nodes
/// (figures 4, 5). `direction`: an arrow where it moved to; ground: a line below its lowest node.
Panel body_panel(const core::Body& body, const BirthStages& born,
                 std::optional<Point> direction = std::nullopt, bool ground = false);

/// A body in motion (figures 3, 6): its nodes at `x`, `y`, every triangle coloured by S/S0.
Panel motion_panel(const core::Body& body, std::span<const double> x, std::span<const double> y,
                   bool ground = false);

/// A body with the phase shift of every cell in colour (figure 9); `direction` and `ground` as
/// above.
Panel phase_panel(const core::Body& body, std::optional<Point> direction = std::nullopt,
                  bool ground = false);

}  // namespace metamorph::evolve
