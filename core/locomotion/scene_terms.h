#pragma once

#include <cmath>
#include <numbers>

#include "kernels/body_step.h"
#include "metamorph/motion.h"
#include "metamorph/scene.h"

namespace metamorph::core {

/// The terms that act in a scene.
inline kernels::Terms terms_of(const Scene& scene, kernels::Actuation actuation) {
  return {.pressure = scene.pressure > 0,
          .drag = scene.drag,
          .ground = scene.ground,
          .extra = false,
          .actuation = actuation};
}

/// The coefficients of a scene's run; those of settling and the ramp are set on the way.
template <class T>
kernels::StepCoefficients<T> coefficients_of(const Scene& scene, Method method) {
  kernels::StepCoefficients<T> c;
  const double angle = scene.slope_degrees * std::numbers::pi / 180;
  c.step = static_cast<T>(scene.step);
  c.extrapolate = method == Method::drift_kick_drift ? static_cast<T>(scene.step / 2) : T(0);
  c.stiffness = static_cast<T>(scene.stiffness);
  c.damping = static_cast<T>(scene.damping);
  c.pressure = static_cast<T>(scene.pressure);
  c.drag_normal = static_cast<T>(scene.drag_normal);
  c.drag_tangential = static_cast<T>(scene.drag_tangential);
  c.gravity_x = static_cast<T>(-scene.gravity * std::sin(angle));
  c.gravity_y = static_cast<T>(-scene.gravity * std::cos(angle));
  c.friction = static_cast<T>(scene.friction);
  c.settle_drag = static_cast<T>(scene.settle_drag);
  return c;
}

}  // namespace metamorph::core
