#pragma once

#include "evolve/run/run_reader.h"
#include "evolve/view/field.h"

namespace metamorph::evolve {

/// Every filled niche of a run of map-elites at the end of what is recorded, in the colour of its
/// elite's eq 6. Throws InputError: a run without elites, or without two axes.
Field map_of(const RunReader& run);

/// Whom nobody dominates in some generations of a run of nsga2, evenly spread, the last one among
/// them. Throws InputError: a run without fronts, or without two trials.
Field front_of(const RunReader& run);

}  // namespace metamorph::evolve
