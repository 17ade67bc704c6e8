#pragma once

#include "core/body.h"
#include "core/locomotion.h"
#include "core/scene.h"

namespace metamorph::core {

/// Largest stable step of a body at rest (NUMERICS section 3), time units.
///
/// For a mode with frequency w and damping rate g, drift-kick-drift is stable while
/// h^2 w^2 + 4 h g <= 4 and symplectic Euler while h^2 w^2 + 2 h g <= 4. Here that is the largest h
/// for which the largest eigenvalue of h^2 K + s h C stays below 4, with K the stiffness of springs
/// and pressure at rest, C the matrix of the dampers, s = 4 or 2.
struct StepLimit {
  double safe;   ///< from row sums, never above the true limit
  double sharp;  ///< by power iteration, within about 3 % of the true limit
};

/// `damping` is the spring damping in force: the scene's, or settle_damping while settling.
StepLimit step_limit(const Body& body, const Scene& scene, double damping, Method method);

/// True if the scene's steps, of the run and of settling, are within the limit for this body.
/// Cheap: the sharp limit is computed only where the safe one does not already decide.
bool step_is_stable(const Body& body, const Scene& scene, Method method);

}  // namespace metamorph::core
