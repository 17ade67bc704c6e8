#pragma once

#include <vector>

#include "evolve/film/timeline.h"
#include "evolve/view/panel.h"

namespace metamorph::evolve {

enum class CameraKind {
  follow,  ///< goes with the body
  stay,    ///< stands where it starts and shows twice as much
  path,    ///< shows all of its path
};

/// A motion as it is seen: turned, so that a slope is one.
struct View {
  std::vector<Point> centres;  ///< [frames] of the nodes, not turned, d
  std::vector<Point> targets;  ///< [frames] what the camera looks at, turned
  double sine = 0, cosine = 1;
  double reach = 0;                        ///< farthest that a node is ever from the centre, d
  double half_width = 0, half_height = 0;  ///< that the camera must show, d

  Point turned(double x, double y) const { return {cosine * x - sine * y, sine * x + cosine * y}; }
};

View view_of(const Motion& motion, CameraKind camera);

/// The same of development: centres of the embryo at every step.
View view_of_development(const Life& life);

}  // namespace metamorph::evolve
