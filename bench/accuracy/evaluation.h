#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "bench/accuracy/methods.h"
#include "core/reference/system.h"

namespace metamorph::bench {

/// False once a node is not finite, a triangle is inverted or a node faster than 4 sqrt(k/m) d.
inline bool sound(const core::ReferenceSystem& system, double h) {
  return system.examine(h).fault == kernels::reference::Fault::none;
}

/// One evaluation (MODEL section 4), settled by `settle_method` with the scene's settle_step, then
/// run with steps made by `step(system, t, h)`, each counted as one evaluation.
template <class Step>
Measured evaluate(const core::Body& body, const core::Scene& scene,
                  core::ReferenceMethod settle_method, Step&& step) {
  const double begin = thread_seconds();
  Measured result;
  result.outcome = core::describe(body);
  core::ReferenceSystem system(body, scene);
  const auto steps_in = [](int paper_steps, double h) {
    return std::llround(paper_steps * core::paper_step / h);
  };
  const auto finish = [&]() -> Measured& {
    result.evaluations = static_cast<double>(result.outcome.steps);
    result.seconds = thread_seconds() - begin;
    return result;
  };
  const auto count = [&](double h) {
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
  if (core::settles(scene)) {
    system.set_settling(true);
    const double h = scene.settle_step;
    const auto wanted = steps_in(scene.settle_quiet_steps, h);
    const auto limit = steps_in(scene.settle_max_steps, h);
    for (std::int64_t quiet = 0, n = 0; quiet < wanted && n < limit; ++n) {
      system.step(settle_method, 0, h);
      if (!count(h)) return finish();
      quiet = system.max_speed() < scene.settle_speed ? quiet + 1 : 0;
      if (n + 1 == limit && quiet < wanted) result.outcome.status = core::Status::not_settled;
    }
    result.outcome.settle_time = static_cast<double>(result.outcome.steps) * h;
    system.set_settling(false);
    std::fill(system.ax.begin(), system.ax.end(), 0.0);
    std::fill(system.ay.begin(), system.ay.end(), 0.0);
  }
  result.x0 = system.x;
  result.y0 = system.y;
  const auto start = system.mean_position();
  const auto steps = steps_in(scene.run_steps, scene.step);
  for (std::int64_t n = 0; n < steps; ++n) {
    step(system, static_cast<double>(n) * scene.step, scene.step);
    if (!count(scene.step)) return finish();
  }
  const auto end = system.mean_position();
  result.outcome.distance = core::travelled(scene.distance, end[0] - start[0], end[1] - start[1]);
  result.outcome.mean_position = {end[0] - start[0],
                                  end[1] - (core::measures_height(scene) ? 0 : start[1])};
  result.x = system.x;
  result.y = system.y;
  return finish();
}

}  // namespace metamorph::bench
