#include "evolve/evaluation/describe.h"

#include <algorithm>

#include "metamorph/shape.h"

namespace metamorph::evolve {
namespace {

void describe_body(TrialDescriptors& descriptors, const core::Body& body) {
  const core::Shape shape = core::shape_of(body);
  descriptors.cells = body.node_count();
  descriptors.elongation = shape.elongation;
  descriptors.compactness = shape.compactness;
  descriptors.symmetry = shape.symmetry;
  descriptors.limbs = shape.limbs;
  descriptors.mean_period = shape.mean_period;
  descriptors.phase_coherence = shape.phase_coherence;
}

/// Growth and turnover count the cells of the embryos, as figures 15 to 18 of the paper do.
void describe_metamorphosis(TrialDescriptors& descriptors, const core::Embryo& before,
                            const core::Embryo& after) {
  const double cells = before.cell_count();
  const int born = after.created - before.created, died = after.died - before.died;
  descriptors.growth = after.cell_count() / cells;
  descriptors.turnover = (born + died) / cells;
}

}  // namespace

int stage_before(const EvaluationRules& rules, int stage) {
  int before = -1;
  for (const Trial& trial : rules.trials) {
    if (trial.stage < stage) before = std::max(before, trial.stage);
  }
  return before;
}

std::vector<TrialDescriptors> describe_stages(const EvaluationRules& rules,
                                              std::span<const int> stages,
                                              std::span<const core::Embryo> embryos,
                                              std::span<const core::Extraction> bodies) {
  std::vector<TrialDescriptors> described(stages.size());
  for (std::size_t s = 0; s < stages.size(); ++s) {
    if (bodies[s].status != core::Status::ok) continue;
    describe_body(described[s], bodies[s].body);
    if (s == 0 || bodies[s - 1].status != core::Status::ok ||
        stages[s - 1] != stage_before(rules, stages[s])) {
      continue;
    }
    describe_metamorphosis(described[s], embryos[s - 1], embryos[s]);
    described[s].reshaping = 1 - core::overlap(bodies[s - 1].body, bodies[s].body);
  }
  return described;
}

void describe_motion(TrialDescriptors& descriptors, const core::Outcome& outcome) {
  const bool failed = core::is_failure(outcome.status);
  descriptors.height = failed ? TrialDescriptors::unknown : outcome.height;
  descriptors.stance = failed ? TrialDescriptors::unknown : outcome.stance;
  descriptors.gait_frequency = failed ? TrialDescriptors::unknown : outcome.gait_frequency;
}

}  // namespace metamorph::evolve
