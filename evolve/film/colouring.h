#pragma once

#include <span>
#include <string>
#include <vector>

#include "evolve/life/life.h"
#include "evolve/view/colour.h"

namespace metamorph::evolve {

/// What the colours of a film say.
enum class ColourKind {
  area,     ///< of a triangle: expanded or contracted
  phase,    ///< phase shift of a cell
  period,   ///< its period
  speed,    ///< how fast a node moves
  birth,    ///< the stage of life a cell was born in
  contact,  ///< what a node touches: the ground, its own body
};

/// What scales reach to, over all lives of a film.
struct Scales {
  double shortest_period = 0, longest_period = 0;  ///< time units
  double highest_speed = 0;                        ///< d per time unit; of 99 % of all speeds
  int stages = 1;
};
Scales scales_of(std::span<const Life* const> lives);

/// Colours of a body's cells at a frame of its motion. Not of ColourKind::area, which belongs to
/// triangles.
std::vector<Colour> node_colours(const Motion& motion, int frame, ColourKind kind,
                                 const Scales& scales);

/// Colours of an embryo's cells: phase and period where they are asked for, else births. `starts`
/// as in birth_stage().
std::vector<Colour> cell_colours(const core::Embryo& embryo, std::span<const int> starts,
                                 ColourKind kind, const Scales& scales);

/// What the colours of an embryo say where those of bodies say `kind`.
ColourKind of_embryos(ColourKind kind);

}  // namespace metamorph::evolve
