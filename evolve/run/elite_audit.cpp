#include "evolve/run/elite_audit.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "evolve/files/input_error.h"
#include "evolve/run/sqlite.h"
#include "evolve/search/population_json.h"
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

/// The last row of every niche.
std::vector<Genome> read_elites(const RunReader& run, MapAudit& audited) {
  Database record(run.file(), Database::Mode::read);
  Statement known(record, "SELECT count(*) FROM sqlite_master WHERE name = 'elites'");
  known.step();
  if (known.integer(0) == 0) {
    throw InputError(
        fmt::format("{}: has no table elites: expected a run of map-elites", run.file().string()));
  }
  Statement niches(record, "SELECT niches FROM qd LIMIT 1");
  if (niches.step()) audited.niches = static_cast<int>(niches.integer(0));
  Statement last(record,
                 "SELECT niche, individual, quality, genome, max(generation) FROM elites GROUP BY "
                 "niche ORDER BY niche");
  std::vector<Genome> genomes;
  while (last.step()) {
    audited.elites.push_back({static_cast<int>(last.integer(0)), last.integer(1), last.real(2), 0});
    try {
      genomes.push_back(genome_of(nlohmann::json::parse(last.text(3))));
    } catch (const nlohmann::json::exception& error) {
      throw InputError(fmt::format("{}: elite of niche {}: {}", run.file().string(),
                                   last.integer(0), error.what()));
    }
  }
  if (genomes.empty()) {
    throw InputError(
        fmt::format("{}: no niche is filled yet: expected one at least", run.file().string()));
  }
  return genomes;
}

}  // namespace

MapAudit audit_elites(const RunReader& run, const EliteAuditOptions& options,
                      const std::function<void(int, int)>& progress) {
  run.verify();
  const Experiment experiment = run.experiment();
  MapAudit audited;
  std::vector<core::Network> networks;
  for (const Genome& genome : read_elites(run, audited)) {
    networks.push_back(compile(genome, shape_of(experiment.development)));
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
