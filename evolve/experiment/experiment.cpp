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

}  // namespace metamorph::evolve
