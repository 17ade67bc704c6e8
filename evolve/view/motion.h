#pragma once

#include <vector>

#include "evolve/view/draw.h"
#include "metamorph/locomotion.h"

namespace metamorph::evolve {

/// Moves a body and returns `count` snapshots evenly spread over its last cycle (the median period
/// of its nodes), as in figures 3 and 6. Of a body that fails numerically, only those before.
std::vector<Snapshot> last_cycle(const core::Body& body, const core::Scene& scene,
                                 const core::LocomotionOptions& options, int count);

}  // namespace metamorph::evolve
