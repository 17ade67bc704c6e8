#pragma once

#include "metamorph/body.h"
#include "metamorph/reference.h"
#include "metamorph/scene.h"

namespace metamorph::core {

/// Largest stable step of a body at rest by linear theory, time units: the forces of springs,
/// dampers and pressure are differenced about rest, and the spectrum of that linear system is
/// computed in full. Without friction, drag and ground. A second opinion on step_limit(), and the
/// only one for the methods that the fast simulator does not have:
/// - symplectic_euler, drift_kick_drift: h^2 K + s h C has no eigenvalue above 4, s = 2 or 4;
/// - midpoint, runge_kutta_4: |R(h lambda)| <= 1 for every eigenvalue lambda of the first-order
///   system, R the polynomial of the method; a growth of 1e-4 per step counts
///   as none. (Midpoint always grows without damping, so that its limit is small and arbitrary.)
/// velocity_verlet: not known in closed form (stiffness and damping do not commute);
/// std::invalid_argument. Cost grows with the cube of the nodes: a minute for 256.
double linear_step_limit(const Body& body, const Scene& scene, double damping,
                         ReferenceMethod method);

}  // namespace metamorph::core
