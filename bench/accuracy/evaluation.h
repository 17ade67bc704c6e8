#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "bench/accuracy/methods.h"
#include "core/reference_system_detail.h"

namespace metamorph::bench {

/// False once a node is not finite, a triangle is inverted or a node faster than 4 sqrt(k/m) d.
inline bool sound(const core::ReferenceSystem& system, double h) {
  return system.examine(h).fault == kernels::reference::Fault::none;
}

/// One evaluation (MODEL section 4) with steps made by `step(system, t, h)`; settling with its own
/// size of step. `settled(system)` is called at the start of actuation.
template <class Step, class Settled>
Measured evaluate(const core::Body& body, const core::Scene& scene, double settle_step,
                  double evaluations_per_step, Step&& step, Settled&& settled) {
  const double begin = thread_seconds();
  Measured result;
  result.outcome = core::describe(body);
  core::ReferenceSystem system(body, scene);
  const auto steps_in = [](int paper_steps, double h) {
    return std::llround(paper_steps * core::paper_step / h);
  };
  const auto finish = [&]() -> Measured& {
    result.evaluations = evaluations_per_step * static_cast<double>(result.outcome.steps);
    result.seconds = thread_seconds() - begin;
    return result;
  };
  const auto advance = [&](double t, double h) {
    step(system, t, h);
    ++result.outcome.steps;
    const auto health = system.examine(h);
    result.outcome.min_area_ratio = std::min(result.outcome.min_area_ratio, health.min_area_ratio);
    result.outcome.max_speed = std::max(result.outcome.max_speed, health.max_speed);
    if (health.fault == kernels::reference::Fault::none) return true;
    result.outcome.status = health.fault == kernels::reference::Fault::inverted
                                ? core::Status::inverted
                                : core::Status::speed;
    return false;
  };
  if (scene.ground) {
    system.set_settling(true);
    const auto wanted = steps_in(scene.settle_quiet_steps, settle_step);
    const auto limit = steps_in(scene.settle_max_steps, settle_step);
    for (std::int64_t quiet = 0, n = 0; quiet < wanted && n < limit; ++n) {
      if (!advance(0, settle_step)) return finish();
      quiet = system.max_speed() < scene.settle_speed ? quiet + 1 : 0;
      if (n + 1 == limit && quiet < wanted) result.outcome.status = core::Status::not_settled;
    }
    result.outcome.settle_time = static_cast<double>(result.outcome.steps) * settle_step;
    system.set_settling(false);
  }
  settled(system);
  result.x0 = system.x;
  result.y0 = system.y;
  const auto start = system.mean_position();
  const auto steps = steps_in(scene.run_steps, scene.step);
  for (std::int64_t n = 0; n < steps; ++n)
    if (!advance(static_cast<double>(n) * scene.step, scene.step)) return finish();
  const auto end = system.mean_position();
  result.outcome.distance = core::travelled(scene.distance, end[0] - start[0], end[1] - start[1]);
  result.x = system.x;
  result.y = system.y;
  return finish();
}

}  // namespace metamorph::bench
