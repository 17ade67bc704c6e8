#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "evolve/view/sheet.h"
#include "metamorph/body.h"
#include "metamorph/development.h"
#include "metamorph/outcome.h"
#include "metamorph/scene.h"

namespace metamorph::evolve {

/// One stage of an animat for a picture: what it grew into, and how it did.
struct Stage {
  std::string title;  ///< "larva", "adult"
  core::Embryo embryo;
  core::Body body;  ///< no nodes: there is none
  std::optional<core::Outcome> outcome;
  std::string scene;    ///< name, for the caption
  bool ground = false;  ///< drawn on a ground line
};

/// Where it went, if it did: in the plane in water and along the ground on land.
std::optional<Point> direction_of(const Stage& stage);

/// Embryos above, bodies below, stages side by side, to one scale, with distances and arrows in the
/// direction of movement (figures 4, 5). Cells have the colour of the stage they were born in;
/// `starts`: the steps at which the stages after the first begin, ascending.
Sheet champion_sheet(std::span<const Stage> stages, std::span<const int> starts);

/// Development (figure 4): embryos at ascending steps above the bodies they would become, a dashed
/// line where a metamorphosis begins. `bodies` may hold bodies without nodes.
Sheet development_sheet(std::span<const core::Embryo> embryos, std::span<const core::Body> bodies,
                        std::span<const int> starts);

/// The nodes of a body in motion at one moment.
struct Snapshot {
  double time = 0;           ///< time units since the start of actuation
  std::vector<double> x, y;  ///< [nodes], d
};

/// Snapshots in rows of `columns`, regions expanded red and contracted blue (figures 3, 6).
Sheet motion_sheet(const core::Body& body, std::span<const Snapshot> snapshots, bool ground,
                   int columns = 4);

/// Phase shifts of the stages' cells in colour (figure 9).
Sheet phase_sheet(std::span<const Stage> stages);

}  // namespace metamorph::evolve
