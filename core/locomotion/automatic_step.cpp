#include "metamorph/automatic_step.h"

#include <algorithm>
#include <cmath>

#include "metamorph/stability.h"

namespace metamorph::core {
namespace {

constexpr double steps_per_period = 20;

double chosen_step(const Body& body, const Scene& scene, Method method, bool settling) {
  const StepPhase phase = step_phase(scene, method, settling);
  double limit = safe_step_limit(body, scene, phase.damping, phase.method);
  if (scene.self_collision) {
    // Two nodes that push each other away.
    limit = std::min(limit, mode_step_limit(2 * scene.collision_stiffness, 0, phase.method));
  }
  double step = phase.margin * limit;
  if (!settling) {
    const double shortest = *std::min_element(body.period.begin(), body.period.end());
    step = std::min(step, shortest / steps_per_period);
  }
  const double duration = (settling ? scene.settle_max_steps : scene.run_steps) * paper_step;
  return duration > 0 ? duration / std::max(1.0, std::ceil(duration / step)) : step;
}

}  // namespace

bool chooses_steps(const Scene& scene) {
  return scene.step == automatic_step || scene.settle_step == automatic_step;
}

Scene with_chosen_steps(const Body& body, const Scene& scene, Method method) {
  Scene chosen = scene;
  if (scene.step == automatic_step) chosen.step = chosen_step(body, scene, method, false);
  if (scene.settle_step == automatic_step) {
    chosen.settle_step = chosen_step(body, scene, method, true);
  }
  return chosen;
}

}  // namespace metamorph::core
