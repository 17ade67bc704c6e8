#pragma once

#include <string>

#include "evolve/film/actor.h"
#include "evolve/film/colouring.h"
#include "evolve/view/canvas.h"

namespace metamorph::evolve {

/// The part of a picture that a life is drawn in, layout pixels.
struct Place {
  double left = 0, top = 0, width = 0, height = 0;
};

struct LifeStyle {
  ColourKind colour = ColourKind::area;
  Scales scales;
  double scale = 10;       ///< layout pixels per d
  double fade_steps = 60;  ///< development steps over which births and deaths are seen
};

/// Draws what a life is at a moment.
void draw_life(Canvas& canvas, const Place& place, const Actor& actor, const Moment& moment,
               const LifeStyle& style);

/// Frame of a motion at a moment of it; the last one where it failed before.
int frame_at(const Motion& motion, const Moment& moment);

/// Development step at a moment.
int step_at(const Moment& moment);

}  // namespace metamorph::evolve
