#pragma once

#include "metamorph/body.h"
#include "metamorph/locomotion.h"
#include "metamorph/scene.h"

namespace metamorph::evolve {

/// How a gait answers to a change of its start far below anything a body could feel.
struct NearbyStarts {
  int starts = 0;              ///< changed starts that were run
  int failed = 0;              ///< of them, ended in a failure; left out of the other numbers
  double mean = 0;             ///< distance of the changed starts, d
  double median = 0;           ///< likewise
  double spread = 0;           ///< largest |distance - that of the unchanged start|, d
  double growth = 0;           ///< largest root-mean-square node separation at the end, over the
                               ///< displacement of the start
  bool parted = false;         ///< a mean displacement came to differ by more than 1 % of the
                               ///< distance
  double predictable_for = 0;  ///< time units of actuation until one did; the whole run if none
};

/// Runs `body` and `starts` copies of it with every node displaced by up to `displacement` d in x
/// and in y (the same displacements on every call), settling included, in double precision at the
/// scene's step. If the unchanged start fails, `starts` is 0. One thread.
NearbyStarts run_nearby_starts(const core::Body& body, const core::Scene& scene,
                               core::Method method, int starts, double displacement);

}  // namespace metamorph::evolve
