#include "evolve/run/audit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "core/body/parallel_for.h"
#include "evolve/evaluation/starts.h"
#include "evolve/files/input_error.h"
#include "evolve/run/median.h"
#include "metamorph/automatic_step.h"
#include "metamorph/development.h"
#include "metamorph/extraction.h"
#include "metamorph/reference.h"
#include "metamorph/threads.h"

namespace metamorph::evolve {
namespace {

constexpr double reference_refinement = 4;  // steps of the reference per step of the record

/// The distinct champions of the generations asked for, ascending.
std::vector<Champion> distinct_champions(const RunReader& run, const AuditOptions& options) {
  std::vector<Champion> champions;
  const int generations = run.generations_done();
  for (int g = 0; g < generations; g += options.every) {
    if (g < options.from) continue;
    Champion champion = run.champion(g);
    const bool known = std::any_of(champions.begin(), champions.end(), [&](const Champion& other) {
      return other.genome == champion.genome && other.eq6 == champion.eq6 &&
             other.distances == champion.distances && other.statuses == champion.statuses;
    });
    if (!known) champions.push_back(std::move(champion));
  }
  return champions;
}

/// The best `count` by eq 6, of equals the earliest, in order of their generation.
void keep_best(std::vector<Champion>& champions, int count) {
  if (static_cast<int>(champions.size()) <= count) return;
  std::sort(champions.begin(), champions.end(), [](const Champion& a, const Champion& b) {
    return a.eq6 != b.eq6 ? a.eq6 > b.eq6 : a.generation < b.generation;
  });
  champions.resize(static_cast<std::size_t>(count));
  std::sort(champions.begin(), champions.end(),
            [](const Champion& a, const Champion& b) { return a.generation < b.generation; });
}

core::Extraction body_of(const Genome& genome, const Experiment& experiment, int stage) {
  const std::vector<int> stages = {stage};
  return core::extract_body(embryos_of(experiment, genome, stages).front(), experiment.min_cells);
}

/// The reference's outcome of the starts that the trial has in that generation.
core::Outcome reference_outcome(const core::Body& body, const Experiment& experiment,
                                const Trial& trial, int generation) {
  std::vector<core::Outcome> outcomes;
  for (int s = 0; s < trial.starts; ++s) {
    const core::Body start = start_of(body, trial, s, experiment.seed, generation);
    const core::Scene scene =
        core::with_chosen_steps(start, experiment.scene_of(trial), experiment.locomotion.method);
    core::ReferenceOptions reference;
    reference.step = scene.step / reference_refinement;
    outcomes.push_back(core::simulate_reference(start, scene, reference));
  }
  return combine_starts(outcomes, trial.starts_combine);
}

/// Fills what goes beyond the replay.
void compare(TrialAudit& audited, const Champion& champion, const Experiment& experiment,
             const Trial& trial, const AuditOptions& options) {
  const core::Extraction extraction = body_of(champion.genome, experiment, trial.stage);
  if (extraction.status != core::Status::ok) return;
  audited.compared = true;
  audited.reference = reference_outcome(extraction.body, experiment, trial, champion.generation);
  audited.deviation = relative_deviation(audited.recorded_distance, audited.reference.distance);
  audited.replay_deviation =
      relative_deviation(audited.replay.distance, audited.reference.distance);
  const core::Scene& scene = experiment.scene_of(trial);
  if ((core::has_impacts(scene) || options.nearby_in_water) && options.nearby_starts > 0) {
    const auto nearby = [&](double displacement) {
      return run_nearby_starts(extraction.body, scene, experiment.locomotion.method,
                               options.nearby_starts, displacement);
    };
    audited.nearby = nearby(options.displacement);
    audited.disturbed = nearby(options.disturbance);
  }
}

bool is_failure_name(const std::string& status) {
  return std::any_of(core::all_statuses.begin(), core::all_statuses.end(), [&](core::Status code) {
    return core::is_failure(code) && core::name(code) == status;
  });
}

/// eq 6 from the replays, and from the references where there are any.
void close_champion(ChampionAudit& audited, const Evaluated& replay) {
  Evaluated reference = replay;
  audited.same_bits = true;
  for (std::size_t t = 0; t < audited.trials.size(); ++t) {
    const TrialAudit& trial = audited.trials[t];
    if (trial.compared) reference.trials[t] = trial.reference;
    if (trial.recorded && !trial.same_bits) audited.same_bits = false;
  }
  audited.replay_eq6 = geometric_mean(evaluation_of(replay));
  audited.reference_eq6 = geometric_mean(evaluation_of(reference));
  const bool complete = std::all_of(audited.trials.begin(), audited.trials.end(),
                                    [](const TrialAudit& trial) { return trial.recorded; });
  if (complete && audited.replay_eq6 != audited.champion.eq6) audited.same_bits = false;
  audited.deviation = relative_deviation(audited.champion.eq6, audited.reference_eq6);
  audited.replay_deviation = relative_deviation(audited.replay_eq6, audited.reference_eq6);
}

TrialSummary summary_of(const std::vector<ChampionAudit>& champions, std::size_t trial) {
  TrialSummary summary;
  std::vector<double> recorded, replay, predictable_for, growth, spread, disturbed, luck;
  for (const ChampionAudit& champion : champions) {
    const TrialAudit& audited = champion.trials[trial];
    if (!audited.compared) continue;
    recorded.push_back(audited.deviation);
    replay.push_back(audited.replay_deviation);
    if (core::is_failure(audited.reference.status)) ++summary.reference_failed;
    if (audited.nearby.starts == 0) continue;
    ++summary.nearby;
    summary.disturbed_starts += audited.disturbed.starts;
    summary.disturbed_failed += audited.disturbed.failed;
    growth.push_back(audited.nearby.growth);
    if (audited.nearby.parted) {
      ++summary.unpredictable;
      predictable_for.push_back(audited.nearby.predictable_for);
    }
    if (audited.replay.distance > 0) {
      spread.push_back(audited.nearby.spread / audited.replay.distance);
      disturbed.push_back(audited.disturbed.spread / audited.replay.distance);
      if (audited.disturbed.starts > audited.disturbed.failed) {
        luck.push_back(relative_deviation(audited.replay.distance, audited.disturbed.mean));
      }
    }
  }
  summary.recorded = range_of(recorded);
  summary.replay = range_of(replay);
  summary.predictable_for = median(predictable_for);
  summary.growth = median(growth);
  summary.spread = median(spread);
  summary.luck = range_of(luck);
  summary.disturbed_spread = median(disturbed);
  if (!spread.empty()) {
    summary.worst_spread = *std::max_element(spread.begin(), spread.end());
    summary.worst_disturbed_spread = *std::max_element(disturbed.begin(), disturbed.end());
  }
  return summary;
}

void summarize(RunAudit& result, std::size_t trials) {
  std::vector<double> deviations, replay_deviations, recorded, reference;
  for (const ChampionAudit& champion : result.champions) {
    if (!champion.same_bits) ++result.other_bits;
    deviations.push_back(champion.deviation);
    replay_deviations.push_back(champion.replay_deviation);
    recorded.push_back(champion.champion.eq6);
    reference.push_back(champion.reference_eq6);
  }
  result.recorded = range_of(deviations);
  result.replay = range_of(replay_deviations);
  result.rank_agreement = kendall_tau(recorded, reference);
  for (std::size_t t = 0; t < trials; ++t) {
    result.trials.push_back(summary_of(result.champions, t));
  }
}

}  // namespace

double relative_deviation(double distance, double reference) {
  const double larger = std::max(distance, reference);
  return larger > 0 ? (distance - reference) / larger : 0;
}

double kendall_tau(const std::vector<double>& a, const std::vector<double>& b) {
  const auto sign = [](double u, double v) { return (u > v ? 1 : 0) - (u < v ? 1 : 0); };
  double agreement = 0, pairs_a = 0, pairs_b = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const int order_a = sign(a[i], a[j]), order_b = sign(b[i], b[j]);
      agreement += order_a * order_b;
      pairs_a += order_a * order_a;
      pairs_b += order_b * order_b;
    }
  }
  if (pairs_a == 0 && pairs_b == 0) return 1;
  if (pairs_a == 0 || pairs_b == 0) return 0;
  return agreement / std::sqrt(pairs_a * pairs_b);
}

int confirmed_within(const RunAudit& audited, double share, bool replay) {
  return static_cast<int>(std::count_if(
      audited.champions.begin(), audited.champions.end(), [&](const ChampionAudit& champion) {
        // A replay that failed has no reference to be confirmed by.
        return (replay ? champion.replay_eq6 : champion.champion.eq6) > 0 &&
               std::abs(replay ? champion.replay_deviation : champion.deviation) <= share;
      }));
}

DeviationRange range_of(std::vector<double> deviations) {
  DeviationRange range;
  range.count = static_cast<int>(deviations.size());
  if (deviations.empty()) return range;
  range.worst = *std::max_element(deviations.begin(), deviations.end(),
                                  [](double a, double b) { return std::abs(a) < std::abs(b); });
  range.bias = median(deviations);
  for (double& deviation : deviations) deviation = std::abs(deviation);
  range.median = median(std::move(deviations));
  return range;
}

RunAudit audit(const RunReader& run, const AuditOptions& options,
               const std::function<void(int, int)>& progress) {
  run.verify();
  const Experiment experiment = run.experiment();
  RunAudit result;
  std::vector<Champion> champions = distinct_champions(run, options);
  if (champions.empty()) {
    throw InputError(
        run.generations_done() == 0
            ? fmt::format("{}: no generation is recorded yet: expected one at least",
                          run.file().string())
            : fmt::format(
                  "--from {}: expected a generation divisible by {} from there on, below {}",
                  options.from, options.every, run.generations_done()));
  }
  result.distinct = static_cast<int>(champions.size());
  keep_best(champions, options.champions);
  const std::size_t trials = experiment.trials.size();
  for (Champion& champion : champions) {
    ChampionAudit& audited = result.champions.emplace_back();
    audited.champion = std::move(champion);
    audited.trials.resize(trials);
  }

  const int threads = core::thread_count(options.threads);
  const EvaluationRules rules = rules_of(experiment);
  std::vector<Evaluated> replays(result.champions.size());
  core::parallel_for<core::Schedule::dynamic>(replays.size(), threads, [&](std::size_t c) {
    const Champion& champion = result.champions[c].champion;
    // By itself, because the starts may be those of its generation.
    replays[c] = Evaluator(rules, 1).evaluate_fully(networks_of(experiment, champion.genome),
                                                    champion.generation);
  });
  for (std::size_t c = 0; c < replays.size(); ++c) {
    const Champion& champion = result.champions[c].champion;
    for (std::size_t t = 0; t < trials; ++t) {
      TrialAudit& audited = result.champions[c].trials[t];
      audited.recorded = !champion.statuses[t].empty();
      audited.recorded_status = champion.statuses[t];
      audited.recorded_distance = champion.distances[t];
      audited.replay = replays[c].trials[t];
      audited.same_bits = audited.recorded_status == core::name(audited.replay.status) &&
                          audited.recorded_distance == audited.replay.distance;
    }
  }

  const std::size_t count = result.champions.size() * trials;
  int done = 0;
  std::mutex progressing;
  core::parallel_for<core::Schedule::dynamic>(count, threads, [&](std::size_t n) {
    ChampionAudit& champion = result.champions[n / trials];
    TrialAudit& audited = champion.trials[n % trials];
    if (audited.recorded && !core::is_failure(audited.replay.status) &&
        !is_failure_name(audited.recorded_status)) {
      compare(audited, champion.champion, experiment, experiment.trials[n % trials], options);
    }
    const std::lock_guard lock(progressing);
    if (progress) progress(++done, static_cast<int>(count));
  });
  for (std::size_t c = 0; c < replays.size(); ++c) {
    close_champion(result.champions[c], replays[c]);
  }
  summarize(result, trials);
  return result;
}

}  // namespace metamorph::evolve
