#pragma once

#include "metamorph/body.h"
#include "metamorph/motion.h"
#include "metamorph/scene.h"

namespace metamorph::core {

/// Largest stable step of a body at rest (NUMERICS section 3), time units.
///
/// For a mode with frequency w and damping rate g, drift-kick-drift is stable while
/// h^2 w^2 + 4 h g <= 4 and symplectic Euler while h^2 w^2 + 2 h g <= 4. Here that is the largest h
/// for which the largest eigenvalue of h^2 K + s h C stays below 4, with K the stiffness of springs
/// and pressure at rest, C the matrix of the dampers, s = 4 or 2.
struct StepLimit {
  double safe;   ///< from row sums, never above the true limit
  double sharp;  ///< by power iteration, mostly within 2 % above the true limit
};

/// Of one mode, unit mass: h with h^2 stiffness + s h damping = 4; infinite without both.
double mode_step_limit(double stiffness, double damping, Method method);

/// `damping` is the spring damping in force: the scene's, or settle_damping while settling.
StepLimit step_limit(const Body& body, const Scene& scene, double damping, Method method);
double safe_step_limit(const Body& body, const Scene& scene, double damping, Method method);

/// Share of the largest stable step that a step may take without a warning. The limit is that of
/// the body at rest; measured in actuated scenes it is lower (NUMERICS section 3).
inline constexpr double water_margin = 0.9;     ///< measured: 0.94 to 1.0 of the limit at rest
inline constexpr double land_margin = 0.6;      ///< 0.66 on: impacts squeeze triangles
inline constexpr double settling_margin = 0.9;  ///< nothing swings, and what moves is damped

/// What steps a scene takes, while it settles or in the run.
struct StepPhase {
  double step;     ///< time units
  double damping;  ///< spring damping in force
  Method method;
  double margin;
};
StepPhase step_phase(const Scene& scene, Method method, bool settling);

enum class StepUse {
  safe,       ///< within the margin
  close,      ///< stable at rest, beyond the margin: a reason to warn
  too_large,  ///< beyond the limit
};

/// How much of its limit a scene's step takes.
struct StepFinding {
  StepUse use = StepUse::safe;
  bool settling = false;  ///< it is the step of settling
};

/// The worse of the scene's steps (of the run, and of settling where the scene settles) for this
/// body. Cheap: the sharp limit is looked at only where row sums do not already decide.
StepFinding assess_steps(const Body& body, const Scene& scene, Method method);

}  // namespace metamorph::core
