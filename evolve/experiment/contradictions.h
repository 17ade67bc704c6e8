#pragma once

#include <string>
#include <vector>

#include "evolve/experiment/experiment.h"

namespace metamorph::evolve {

/// Two keys that are each in range but exclude each other.
struct Contradiction {
  std::string key;       ///< full path of the key to blame
  std::string expected;  ///< what its value had to be, and why
};

/// Everything in an experiment that contradicts something else in it. Empty if it can run.
std::vector<Contradiction> contradictions(const Experiment& experiment);

}  // namespace metamorph::evolve
