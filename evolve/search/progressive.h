#pragma once

#include "metamorph/evaluation.h"

namespace metamorph::evolve {

/// w of eq 7 for stage k >= 1 of `stages` in a generation: of 2 stages - 1 equal parts of all
/// generations it rises linearly in the part 2 k - 1, counted from 0; before that it is 0, after it
/// 1. For two stages: 0 in the first third, 1 in the last. Stage 0 has weight 1.
double progressive_weight(int stage, int stages, int generation, int generations);

/// eq 7: the geometric mean of the objectives of the first stage as they are and of those of every
/// later stage k as w_k (objective - 1) + 1, times the factor. `stage` and `weight`: [objectives]
/// and [stages].
double progressive_fitness(const Evaluation& evaluation, const std::vector<int>& stage,
                           const std::vector<double>& weight);

}  // namespace metamorph::evolve
