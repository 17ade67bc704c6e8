#pragma once

#include <string>

#include "evolve/run/evaluate.h"

namespace metamorph::evolve {

/// A duration for people: "12.3 s", "4 min 05 s", "3 h 07 min".
std::string duration_text(double seconds);

/// "with a step above 90 % (water), 50 % (land) or 90 % (settling) of its limit"; the margins are
/// those of core/stability.h.
std::string near_limit_text();

/// What had not to be computed again: "39 of 300 developments (13.0 %), 88 of 560 simulations
/// (15.7 %)"; empty if nothing was to be computed.
std::string saved_text(const EvaluationWork& work);

}  // namespace metamorph::evolve
