#include "metamorph/scene.h"

#include <algorithm>
#include <cmath>

namespace metamorph::core {

double travelled(DistanceRule rule, double dx, double dy) {
  switch (rule) {
    case DistanceRule::euclidean:
      return std::sqrt(dx * dx + dy * dy);
    case DistanceRule::horizontal:
      return std::abs(dx);
    case DistanceRule::rightward:
      return std::max(dx, 0.0);
  }
  return 0;
}

bool settles(const Scene& scene) { return scene.ground; }
bool starts_on_ground(const Scene& scene) { return scene.ground; }
bool measures_height(const Scene& scene) { return scene.ground; }
bool has_impacts(const Scene& scene) { return scene.ground; }
bool shows_ground(const Scene& scene) { return scene.ground; }

Scene water_scene() { return {}; }

Scene land_scene() {
  Scene scene;
  scene.name = "land";
  scene.drag = false;
  scene.ground = true;
  scene.step = 0.15;
  scene.distance = DistanceRule::horizontal;
  return scene;
}

Scene land_right_scene() {
  Scene scene = land_scene();
  scene.name = "land-right";
  scene.distance = DistanceRule::rightward;
  return scene;
}

Scene slope_scene() {
  Scene scene = land_right_scene();
  scene.name = "slope";
  scene.slope_degrees = 17.0;
  scene.friction = 2.0;       // with less hardly anything learns to climb
  scene.settle_range = 10.0;  // what rolls down will never rest
  return scene;
}

}  // namespace metamorph::core
