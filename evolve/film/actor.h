#pragma once

#include <array>
#include <vector>

#include "evolve/film/camera.h"
#include "evolve/film/timeline.h"
#include "evolve/life/life.h"

namespace metamorph::evolve {

/// A cell that is no more.
struct Death {
  int step = 0;   ///< the first step without it
  Point place;    ///< where it was the step before
  int stage = 0;  ///< of life, in which it was born
};

/// A life with all that is worked out once for all frames of its film.
struct Actor {
  Life life;
  std::vector<Shot> shots;
  View development;                                    ///< how the embryo is seen
  std::vector<View> views;                             ///< [motions]
  std::vector<std::vector<std::array<int, 2>>> edges;  ///< [motions] of the outline
  std::vector<Death> deaths;                           ///< by step
};

/// Precondition: there is a shot.
Actor actor_of(Life life, std::vector<Shot> shots, CameraKind camera);

}  // namespace metamorph::evolve
