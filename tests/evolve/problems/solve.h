#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "metamorph/network.h"
#include "metamorph/searches.h"

namespace metamorph::evolve::testing {

/// A search for a problem of so many inputs (and the bias) and outputs, one objective, that starts
/// without hidden nodes. All else is as the library has it.
SearchSetup minimal_setup(int inputs, int outputs, int population, std::uint64_t seed);

/// What came of a run. Evaluations are counted by whole generations.
struct Attempt {
  bool solved = false;
  int evaluations = 0;
  double best = 0;  ///< highest first objective that was told
};

/// Evaluates a generation and says whether it holds a solution.
using Generation =
    std::function<bool(const std::vector<core::Network>&, std::vector<Evaluation>& evaluations)>;

/// Asks, evaluates and tells until a generation holds a solution, or another one would be more than
/// `cap` evaluations.
Attempt attempt(const SearchSetup& setup, int cap, const Generation& generation);

/// As above where each network stands for itself: evaluate(network, evaluation) says whether it is
/// a solution.
Attempt attempt(const SearchSetup& setup, int cap,
                const std::function<bool(const core::Network&, Evaluation&)>& evaluate);

}  // namespace metamorph::evolve::testing
