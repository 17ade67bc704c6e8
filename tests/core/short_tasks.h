#pragma once

#include <cstdint>
#include <vector>

#include "metamorph/locomotion.h"
#include "tests/bodies.h"

namespace metamorph::tests {

/// Short scenes: bits are decided in the first steps as well as in the last.
inline std::vector<core::Scene> short_scenes() {
  std::vector<core::Scene> scenes = {core::water_scene(), core::land_scene(),
                                     core::land_right_scene(), core::slope_scene()};
  for (core::Scene& scene : scenes) {
    scene.run_steps = 100;
    scene.settle_max_steps = 40;
  }
  return scenes;
}

/// Bodies of many sizes, each in one of the scenes.
struct Tasks {
  std::vector<core::Body> bodies;
  std::vector<core::Scene> scenes = short_scenes();
  std::vector<core::LocomotionTask> tasks;

  explicit Tasks(int count) {
    for (int i = 0; i < count; ++i) {
      bodies.push_back(blob_body(24 + (i * 37) % 200, static_cast<std::uint64_t>(i + 1)));
    }
    for (int i = 0; i < count; ++i) {
      tasks.push_back({&bodies[static_cast<std::size_t>(i)],
                       &scenes[static_cast<std::size_t>(i) % scenes.size()]});
    }
  }
};

}  // namespace metamorph::tests
