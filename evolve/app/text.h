#pragma once

#include <cstdint>
#include <string>

#include "metamorph/body.h"
#include "metamorph/evaluator.h"
#include "metamorph/outcome.h"

namespace metamorph::evolve {

/// A duration for people: "12.3 s", "4 min 05 s", "3 h 07 min".
std::string duration_text(double seconds);

/// "with a step above 90 % (water), 50 % (land) or 90 % (settling) of its limit"; the margins are
/// those of metamorph/stability.h.
std::string near_limit_text();

/// What had not to be computed again: "39 of 300 developments (13.0 %), 88 of 560 simulations
/// (15.7 %)"; empty if nothing was to be computed.
std::string saved_text(const EvaluationWork& work);

/// Where and how an outcome of a body failed, for people: "failed at step 48: node 12 crossed edge
/// [3, 4]"; empty if it did not, or where the status says all.
std::string failure_text(const core::Outcome& outcome, const core::Body& body);

/// What a batch is about to cost, "5e+13 steps per body, about 24 h 10 min on 2 threads"; empty if
/// it is done in minutes. spring_steps: the sum over the bodies of springs times steps.
std::string work_text(double most_steps, double spring_steps, int threads);

}  // namespace metamorph::evolve
