#pragma once

#include "metamorph/body.h"
#include "metamorph/motion.h"
#include "metamorph/scene.h"

namespace metamorph::core {

/// The scene with each of its steps that is automatic_step replaced by one for this body: its safe
/// limit (metamorph/stability.h) times the margin, made a little smaller so that the run (while
/// settling: its longest time) is a whole number of steps, one at least. It is no more than a
/// twentieth of the shortest oscillation either, and on the ground or with self-collision no more
/// than the margin allows for what these push back with alone. It depends on body, scene and
/// method, on nothing else. Fixed steps stay. Precondition: the body is sound (check()).
Scene with_chosen_steps(const Body& body, const Scene& scene, Method method);

/// True if a step of the scene is to be chosen.
bool chooses_steps(const Scene& scene);

}  // namespace metamorph::core
