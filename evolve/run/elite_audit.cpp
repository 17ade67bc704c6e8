#include "evolve/run/elite_audit.h"

#include "metamorph/metrics.h"
#include "metamorph/threads.h"

namespace metamorph::evolve {
namespace {

constexpr int first_fresh_generation = 2'000'000'000;  // no run has so many

EvaluationRules with_fresh_starts(const Experiment& experiment, double displacement) {
  EvaluationRules rules = rules_of(experiment);
  for (Trial& trial : rules.trials) {
    if (trial.starts_renew || !core::has_impacts(rules.scene_of(trial))) continue;
    trial.starts_renew = true;
    if (trial.starts == 1) trial.start_displacement = displacement;
  }
  return rules;
}

}  // namespace

MapAudit audit_elites(const RunReader& run, const EliteAuditOptions& options,
                      const std::function<void(int, int)>& progress) {
  run.verify();
  const Experiment experiment = run.experiment();
  MapAudit audited;
  std::vector<core::Network> networks;
  const RecordedMap map = run.elites();
  audited.niches = map.niches;
  for (const RecordedElite& elite : map.elites) {
    audited.elites.push_back({elite.niche, elite.individual, elite.quality, 0});
    networks.push_back(compile(elite.genome, shape_of(experiment.development)));
  }
  Evaluator evaluator(with_fresh_starts(experiment, options.displacement),
                      core::thread_count(options.threads));
  const std::vector<std::uint8_t> all(experiment.trials.size(), 1);
  for (int s = 0; s < options.starts; ++s) {
    const std::vector<Evaluated> round =
        evaluator.evaluate(networks, all, first_fresh_generation + s);
    for (std::size_t e = 0; e < round.size(); ++e) {
      audited.elites[e].corrected += geometric_mean(evaluation_of(round[e])) / options.starts;
    }
    if (progress) progress(s + 1, options.starts);
  }
  std::vector<double> recorded, corrected;
  for (const EliteAudit& elite : audited.elites) {
    recorded.push_back(elite.recorded);
    corrected.push_back(elite.corrected);
    audited.fallen += elite.corrected < 0.5 * elite.recorded ? 1 : 0;
  }
  audited.qd_score = map_worth(recorded, audited.niches).qd_score;
  audited.corrected = map_worth(corrected, audited.niches).qd_score;
  return audited;
}

}  // namespace metamorph::evolve
