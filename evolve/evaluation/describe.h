#pragma once

#include <span>
#include <vector>

#include "metamorph/development.h"
#include "metamorph/evaluator.h"
#include "metamorph/extraction.h"
#include "metamorph/outcome.h"

namespace metamorph::evolve {

/// The largest stage of a trial below this one; -1 if there is none.
int stage_before(const EvaluationRules& rules, int stage);

/// What bodies of some stages of a life, [stages] ascending, say of themselves and of the
/// metamorphoses between them: of those between stages that follow one another in the rules.
std::vector<TrialDescriptors> describe_stages(const EvaluationRules& rules,
                                              std::span<const int> stages,
                                              std::span<const core::Embryo> embryos,
                                              std::span<const core::Extraction> bodies);

/// Sets what motion says.
void describe_motion(TrialDescriptors& descriptors, const core::Outcome& outcome);

}  // namespace metamorph::evolve
