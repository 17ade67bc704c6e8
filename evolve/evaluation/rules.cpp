#include <algorithm>
#include <cassert>
#include <cmath>

#include "metamorph/evaluator.h"

namespace metamorph::evolve {

const core::Scene& EvaluationRules::scene_of(const Trial& trial) const {
  const auto found = std::find_if(scenes.begin(), scenes.end(), [&](const core::Scene& scene) {
    return scene.name == trial.scene;
  });
  assert(found != scenes.end());
  return *found;
}

namespace {

/// Final mean positions of all trials one after the other, or nothing.
std::vector<double> behaviour(const Evaluated& evaluated) {
  std::vector<double> positions;
  for (std::size_t t = 0; t < evaluated.trials.size(); ++t) {
    const core::Outcome& outcome = evaluated.trials[t];
    const bool moved =
        outcome.status == core::Status::ok || outcome.status == core::Status::not_settled;
    const auto [x, y] = outcome.mean_position;
    if (!moved || evaluated.evaluated[t] == 0 || !std::isfinite(x) || !std::isfinite(y)) return {};
    positions.push_back(x);
    positions.push_back(y);
  }
  return positions;
}

}  // namespace

Evaluation evaluation_of(const Evaluated& evaluated) {
  Evaluation evaluation;
  for (const core::Outcome& trial : evaluated.trials) {
    evaluation.objectives.push_back(trial.distance);
  }
  evaluation.descriptors = behaviour(evaluated);
  evaluation.factor = evaluated.penalty;
  return evaluation;
}

Problem problem_of(const EvaluationRules& rules, int generations) {
  Problem problem;
  for (const Trial& trial : rules.trials) {
    const int objective = static_cast<int>(problem.objectives.size());
    problem.objectives.push_back({trial.name, trial.stage});
    problem.descriptors.push_back({trial.name + ".x", objective, -50, 50, true});
    problem.descriptors.push_back({trial.name + ".y", objective, -50, 50, true});
  }
  problem.generations = generations;
  problem.seed = rules.seed;
  return problem;
}

}  // namespace metamorph::evolve
