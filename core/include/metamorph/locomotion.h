#pragma once

#include <functional>
#include <span>
#include <vector>

#include "metamorph/motion.h"
#include "metamorph/outcome.h"

namespace metamorph::core {

/// Chooses steps where the scene leaves them to it, settles (where there is gravity) and runs every
/// task; results by task index. The result of a task depends on its body and scene alone: the same
/// bits for any batch, order and thread count.
std::vector<Outcome> simulate(std::span<const LocomotionTask> tasks,
                              const LocomotionOptions& options);

/// Like simulate() for one task, calling `observe` at the start of actuation and then after every
/// `every` integrator steps. Observing changes no bit of the result. What `observe` throws ends the
/// run and reaches the caller.
Outcome simulate_observed(const LocomotionTask& task, const LocomotionOptions& options, int every,
                          const std::function<void(const Frame&)>& observe);

}  // namespace metamorph::core
