#pragma once

#include <string>
#include <vector>

#include "evolve/film/actor.h"
#include "evolve/film/draw_life.h"
#include "evolve/view/canvas.h"

namespace metamorph::evolve {

/// How the frames of a film look.
struct FrameStyle {
  int width = 1280, height = 720;  ///< pixels
  ColourKind colour = ColourKind::area;
  double speed = 40;  ///< time units per second, for its caption
};

/// Draws the frames of a film of one life, or of several on a grid, all to one scale.
class FrameArtist {
 public:
  /// Precondition: there is an actor.
  FrameArtist(std::vector<Actor> actors, const FrameStyle& style);

  double seconds() const { return seconds_; }

  /// The frame at a second of the film, as Canvas::finish() gives it. The same film gives the same
  /// bytes.
  std::string draw(double second, Canvas::Frame form) const;

 private:
  void draw_one(Canvas& canvas, double second) const;
  void draw_grid(Canvas& canvas, double second) const;
  void draw_foot(Canvas& canvas, double second) const;

  std::vector<Actor> actors_;
  FrameStyle style_;
  LifeStyle life_style_;
  double density_ = 1;             ///< pixels per layout pixel
  double width_ = 0, height_ = 0;  ///< layout pixels
  std::vector<Place> places_;      ///< [actors] that they are drawn in
  double seconds_ = 0;
};

}  // namespace metamorph::evolve
