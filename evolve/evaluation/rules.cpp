#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>
#include <utility>

#include "evolve/evaluation/describe.h"
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

/// Calls visit(trial, field) for what describes an individual beside positions, in order.
template <class Visit>
void for_each_descriptor(std::size_t trials, Visit&& visit) {
  for (const bool of_metamorphosis : {false, true}) {
    for (std::size_t t = 0; t < trials; ++t) {
      for (const DescriptorField& field : descriptor_fields) {
        if (field.of_metamorphosis == of_metamorphosis) visit(t, field);
      }
    }
  }
}

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

/// Where a descriptor is expected: what the rules bound is within their bounds.
std::pair<double, double> range_of(const DescriptorField& field, const EvaluationRules& rules) {
  const core::DevelopmentRules& development = rules.development;
  if (field.member == &TrialDescriptors::cells) {
    return {field.low, static_cast<double>(development.max_cells)};
  }
  if (field.member == &TrialDescriptors::mean_period &&
      development.period_min < development.period_max) {
    return {development.period_min, development.period_max};
  }
  return {field.low, field.high};
}

}  // namespace

Evaluation evaluation_of(const Evaluated& evaluated) {
  Evaluation evaluation;
  for (const core::Outcome& trial : evaluated.trials) {
    evaluation.objectives.push_back(trial.distance);
  }
  evaluation.descriptors = behaviour(evaluated);
  if (!evaluation.descriptors.empty()) {
    for_each_descriptor(evaluated.descriptors.size(), [&](std::size_t t, const auto& field) {
      const double value = evaluated.descriptors[t].*field.member;
      // Of a whole life all is known but the metamorphosis before the first stage.
      assert(field.of_metamorphosis || !std::isnan(value));
      if (!std::isnan(value)) evaluation.descriptors.push_back(value);
    });
  }
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
  for_each_descriptor(rules.trials.size(), [&](std::size_t t, const DescriptorField& field) {
    const Trial& trial = rules.trials[t];
    if (field.of_metamorphosis && stage_before(rules, trial.stage) < 0) return;
    const auto [low, high] = range_of(field, rules);
    problem.descriptors.push_back(
        {trial.name + "." + std::string(field.name), static_cast<int>(t), low, high, false});
  });
  problem.generations = generations;
  problem.seed = rules.seed;
  return problem;
}

}  // namespace metamorph::evolve
