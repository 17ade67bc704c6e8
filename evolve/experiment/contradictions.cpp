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

void check_trials_and_search(const Experiment& e, std::vector<Contradiction>& found) {
  if (e.trials.empty()) {
    found.push_back({"trials", "a [[trials]] table at least, there is none"});
    return;
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
  for (Contradiction& c : faults(search_setup_of(e, 1))) found.push_back(std::move(c));
}

}  // namespace

std::vector<Contradiction> contradictions(const Experiment& e) {
  std::vector<Contradiction> found;
  at_most(found, "development.period_min", e.development.period_min, "development.period_max",
          e.development.period_max);
  at_most(found, "body.min_cells", e.min_cells, "development.max_cells", e.development.max_cells);
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
  check_trials_and_search(e, found);
  return found;
}

}  // namespace metamorph::evolve
