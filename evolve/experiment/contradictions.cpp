#include "evolve/experiment/contradictions.h"

#include <fmt/format.h>

#include <set>

namespace metamorph::evolve {
namespace {

template <class Number>
void at_most(std::vector<Contradiction>& found, const std::string& low_key, Number low,
             const std::string& high_key, Number high) {
  if (low > high) found.push_back({low_key, fmt::format("at most {} = {}", high_key, high)});
}

void check_trials(const Experiment& e, std::vector<Contradiction>& found) {
  if (e.trials.empty() || e.trials.size() > 2) {
    found.push_back(
        {"trials", fmt::format("one or two [[trials]] tables, there are {}", e.trials.size())});
  }
  std::set<std::string> names;
  for (const Trial& trial : e.trials) {
    const std::string path = "trials." + trial.name;
    if (!names.insert(trial.name).second) {
      found.push_back({path + ".name", "a name that no other trial has"});
    }
    at_most(found, path + ".stage", trial.stage, "development.steps", e.development.steps);
    if ((trial.starts > 1 || trial.starts_renew) && trial.start_displacement == 0) {
      found.push_back({path + ".start_displacement", "more than 0: all starts would be one"});
    }
  }
  if (e.search.kind != SearchKind::progressive) return;
  if (e.trials.size() != 2) {
    found.push_back({"search.kind", fmt::format("simple or novelty: progressive search needs two "
                                                "trials (larva, adult), there are {}",
                                                e.trials.size())});
  } else if (e.trials[0].stage >= e.trials[1].stage) {
    found.push_back({"trials." + e.trials[0].name + ".stage",
                     fmt::format("below the second trial's stage = {}: progressive search starts "
                                 "with the earlier stage",
                                 e.trials[1].stage)});
  }
}

}  // namespace

std::vector<Contradiction> contradictions(const Experiment& e) {
  std::vector<Contradiction> found;
  at_most(found, "development.period_min", e.development.period_min, "development.period_max",
          e.development.period_max);
  at_most(found, "search.archive_floor", e.search.archive_floor, "search.archive_threshold",
          e.search.archive_threshold);
  at_most(found, "body.min_cells", e.min_cells, "development.max_cells", e.development.max_cells);
  at_most(found, "neat.species_min", e.neat.species_min, "neat.species_max", e.neat.species_max);
  at_most(found, "neat.compatibility_floor", e.neat.compatibility_floor,
          "neat.compatibility_threshold", e.neat.compatibility_threshold);
  at_most(found, "neat.initial_weight", e.neat.initial_weight, "neat.weight_limit",
          e.neat.weight_limit);
  if (e.neat.mutate_weights <= 0) {
    // A genome may have nothing to remove, no link to add and none to split; a roulette without
    // weight changes could then draw for ever.
    found.push_back({"neat.mutate_weights", "more than 0: the other mutations can all fail"});
  }
  for (const NamedScene& named : e.scenes) {
    const core::Scene& scene = named.scene;
    const std::string path = "scenes." + scene.name;
    if (core::settles(scene)) {
      at_most(found, path + ".settle_quiet_steps", scene.settle_quiet_steps,
              path + ".settle_max_steps", scene.settle_max_steps);
    }
    at_most(found, path + ".step", scene.step, "development.period_min / 4",
            e.development.period_min / 4);
    at_most(found, path + ".step", scene.step, path + ".run_steps * 0.2",
            scene.run_steps * core::paper_step);
    bool used = false;
    for (const Trial& trial : e.trials) used |= trial.scene == scene.name;
    if (!used) found.push_back({path, "a scene that a trial names"});
  }
  check_trials(e, found);
  return found;
}

}  // namespace metamorph::evolve
