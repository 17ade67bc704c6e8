#pragma once

// Random states and small measurements for the tests of physics.

#include <cmath>
#include <vector>

#include "core/reference/system.h"
#include "metamorph/body.h"
#include "metamorph/random.h"
#include "metamorph/scene.h"

namespace metamorph::tests {

/// Only what every body has: springs and pressure, undamped, at rest length; no surroundings.
inline core::Scene vacuum_scene() {
  core::Scene scene;
  scene.name = "vacuum";
  scene.damping = 0;
  scene.amplitude = 0;
  scene.drag = false;
  scene.self_collision = false;
  return scene;
}

/// Moves every node by up to `shift` and sets velocities of up to `speed`, per coordinate.
inline void disturb(core::ReferenceSystem& system, double shift, double speed, std::uint64_t seed) {
  evolve::RandomStream random(evolve::Purpose::test, seed, 0, 0);
  for (std::size_t i = 0; i < system.x.size(); ++i) {
    system.x[i] += shift * (2 * random.uniform() - 1);
    system.y[i] += shift * (2 * random.uniform() - 1);
    system.vx[i] += speed * (2 * random.uniform() - 1);
    system.vy[i] += speed * (2 * random.uniform() - 1);
  }
}

/// `scene` with `duration` time units of actuation.
inline core::Scene lasting(core::Scene scene, double duration) {
  scene.run_steps = static_cast<int>(std::lround(duration / core::paper_step));
  return scene;
}

/// The scene with contacts of the body with itself everywhere: what approaches by less than its
/// distance at rest repels.
inline core::Scene crowded(core::Scene scene) {
  scene.collision_gap = 1.8;
  return scene;
}

inline double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// Pairs that two lists put in another order.
inline int swapped_pairs(const std::vector<double>& a, const std::vector<double>& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) count += (a[i] - a[j]) * (b[i] - b[j]) < 0;
  return count;
}

/// Root of the mean squared distance of two sets of points.
inline double rms_distance(const std::vector<double>& x1, const std::vector<double>& y1,
                           const std::vector<double>& x2, const std::vector<double>& y2) {
  double sum = 0;
  for (std::size_t i = 0; i < x1.size(); ++i)
    sum += (x1[i] - x2[i]) * (x1[i] - x2[i]) + (y1[i] - y2[i]) * (y1[i] - y2[i]);
  return std::sqrt(sum / static_cast<double>(x1.size()));
}

}  // namespace metamorph::tests
