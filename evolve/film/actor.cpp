#include "evolve/film/actor.h"

#include <algorithm>
#include <utility>

namespace metamorph::evolve {
namespace {

std::vector<Death> deaths_of(const Life& life) {
  std::vector<Death> deaths;
  for (std::size_t s = 1; s < life.embryos.size(); ++s) {
    const core::Embryo& before = life.embryos[s - 1];
    const core::Embryo& now = life.embryos[s];
    for (std::size_t i = 0; i < before.id.size(); ++i) {
      if (std::binary_search(now.id.begin(), now.id.end(), before.id[i])) continue;
      deaths.push_back(
          {now.step, {before.x[i], before.y[i]}, birth_stage(before.birth_step[i], life.starts)});
    }
  }
  return deaths;
}

}  // namespace

Actor actor_of(Life life, std::vector<Shot> shots, CameraKind camera) {
  Actor actor;
  actor.development = view_of_development(life);
  for (const Motion& motion : life.motions) {
    actor.views.push_back(view_of(motion, camera));
    actor.edges.push_back(core::outline_of(motion.body.triangles));
  }
  actor.deaths = deaths_of(life);
  actor.life = std::move(life);
  actor.shots = std::move(shots);
  return actor;
}

}  // namespace metamorph::evolve
