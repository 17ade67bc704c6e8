#pragma once

#include <functional>

#include "metamorph/body.h"
#include "metamorph/motion.h"
#include "metamorph/outcome.h"
#include "metamorph/scene.h"

namespace metamorph::core {

/// Time integrators of the reference.
enum class ReferenceMethod {
  symplectic_euler,  ///< order 1
  drift_kick_drift,  ///< order 2, the model's method
  velocity_verlet,   ///< order 2
  midpoint,          ///< order 2; in water only (friction costs it its order)
  runge_kutta_4,     ///< order 4; in water only, likewise
};

/// How the reference computes motion, and who watches.
struct ReferenceOptions {
  ReferenceMethod method = ReferenceMethod::drift_kick_drift;
  double step = 0;  ///< time units; 0: the scene's (or chosen, see metamorph/automatic_step.h)
  int observe_every = 1;  ///< integrator steps
  /// Called at the start of actuation and then after every `observe_every` steps, if set.
  std::function<void(const Frame&)> observe;
};

/// One whole evaluation (MODEL section 4: settling, run, distance) in plain double precision: what
/// the fast simulator is compared with. The stability limit of the step is not checked, so that
/// failures can be watched; what refused_step() refuses is.
Outcome simulate_reference(const Body& body, const Scene& scene,
                           const ReferenceOptions& options = {});

}  // namespace metamorph::core
