#pragma once

#include <string>

#include "evolve/experiment/experiment.h"

namespace metamorph::evolve {

/// What keeps a run of this experiment from fitting into so many free bytes, in one line with the
/// population that would; empty if nothing does. `threads` above 0.
std::string memory_fault(const Experiment& experiment, int threads, double free);

/// Throws InputError if a run of this experiment would not fit into what is free now. `threads` 0:
/// all.
void require_memory(const Experiment& experiment, int threads);

}  // namespace metamorph::evolve
