#include "metamorph/step_refusal.h"

#include <algorithm>
#include <cmath>

namespace metamorph::core {
namespace {

constexpr double fewest_steps_per_period = 4;
constexpr double most_steps = 0x1p53;  ///< counts and times of steps are exact up to here

/// automatic_step, or a number that leads to an end after at most `paper_steps`.
bool is_step(double step, int paper_steps) {
  return step == automatic_step ||
         (step > 0 && std::isfinite(step) && paper_steps * paper_step / step <= most_steps);
}

}  // namespace

std::optional<StepRefusal> refused_step(const Body& body, const Scene& scene) {
  if (!is_step(scene.step, scene.run_steps) ||
      (settles(scene) && !is_step(scene.settle_step, scene.settle_max_steps))) {
    return StepRefusal{Status::bad_input, 0, -1};
  }
  const double duration = scene.run_steps * paper_step;
  const auto shortest = std::min_element(body.period.begin(), body.period.end());
  const double resolved = *shortest / fewest_steps_per_period;
  const bool too_long = duration > 0 && scene.step > duration;
  if (scene.step > resolved && !(too_long && duration < resolved)) {
    return StepRefusal{Status::step_too_large, resolved,
                       static_cast<Index>(shortest - body.period.begin())};
  }
  if (too_long) return StepRefusal{Status::step_too_large, duration, -1};
  return std::nullopt;
}

}  // namespace metamorph::core
