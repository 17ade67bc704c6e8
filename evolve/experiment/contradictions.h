#pragma once

#include <string>
#include <vector>

#include "evolve/experiment/experiment.h"

namespace metamorph::evolve {

/// Everything in an experiment that contradicts something else in it. Empty if it can run.
std::vector<Contradiction> contradictions(const Experiment& experiment);

}  // namespace metamorph::evolve
