#include "evolve/experiment/experiment.h"

#include <algorithm>
#include <cassert>

namespace metamorph::evolve {

const core::Scene& Experiment::scene_of(const Trial& trial) const {
  const auto found = std::find_if(scenes.begin(), scenes.end(), [&](const NamedScene& named) {
    return named.scene.name == trial.scene;
  });
  assert(found != scenes.end());
  return found->scene;
}

std::vector<int> Experiment::stages() const {
  std::vector<int> stages;
  for (const Trial& trial : trials) stages.push_back(trial.stage);
  std::sort(stages.begin(), stages.end());
  stages.erase(std::unique(stages.begin(), stages.end()), stages.end());
  return stages;
}

std::vector<int> Experiment::metamorphoses() const {
  std::vector<int> starts = stages();
  if (!starts.empty()) starts.pop_back();
  return starts;
}

void apply(Preset preset, Experiment& e) {
  e.preset = preset;
  const bool paper = preset == Preset::paper;
  e.neat = paper ? paper_neat_settings() : NeatSettings{};
  e.search.values = paper ? paper_search_settings().values : SearchSettings{}.values;
}

std::vector<core::Network> networks_of(const Experiment& e, const Genome& genome) {
  return compile_stages(genome, shape_of(e.development), static_cast<int>(e.stages().size()));
}

std::vector<core::Embryo> embryos_of(const Experiment& e, const Genome& genome,
                                     std::span<const int> steps) {
  const std::vector<core::Network> life = networks_of(e, genome);
  return core::develop({&life, 1}, e.metamorphoses(), e.development, steps, 1).front();
}

EvaluationRules rules_of(const Experiment& e) {
  EvaluationRules rules{e.development,
                        e.min_cells,
                        e.created_limit,
                        e.created_penalty,
                        e.locomotion.precision,
                        e.locomotion.method,
                        {},
                        e.trials,
                        e.seed};
  for (const NamedScene& named : e.scenes) rules.scenes.push_back(named.scene);
  return rules;
}

SearchSetup search_setup_of(const Experiment& e, int threads) {
  return {e.search, e.neat, problem_of(rules_of(e), e.generations), shape_of(e.development),
          threads};
}

}  // namespace metamorph::evolve
