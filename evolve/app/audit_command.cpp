#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "evolve/app/commands.h"
#include "evolve/app/json_line.h"
#include "evolve/app/options.h"
#include "evolve/app/streams.h"
#include "evolve/files/printable.h"
#include "evolve/run/audit.h"
#include "evolve/run/elite_audit.h"
#include "metamorph/status.h"

namespace metamorph::evolve {
namespace {

struct Arguments {
  std::string run;
  AuditOptions options;
  int elite_starts = 0;  ///< 0: champions are audited, not elites
  bool json = false;
};

std::string percent(double share) { return fmt::format("{:+.3f} %", 100 * share); }

nlohmann::ordered_json json_of(const DeviationRange& range) {
  return {{"count", range.count},
          {"median", range.median},
          {"worst", range.worst},
          {"bias", range.bias}};
}

nlohmann::ordered_json json_of(const NearbyStarts& nearby) {
  return {{"starts", nearby.starts}, {"failed", nearby.failed},
          {"mean", nearby.mean},     {"median", nearby.median},
          {"spread", nearby.spread}, {"growth", nearby.growth},
          {"parted", nearby.parted}, {"predictable_for", nearby.predictable_for}};
}

void print_trial_json(const ChampionAudit& champion, std::size_t t, const Trial& trial) {
  const TrialAudit& audited = champion.trials[t];
  nlohmann::ordered_json json;
  json["generation"] = champion.champion.generation;
  json["individual"] = champion.champion.individual;
  json["trial"] = trial.name;
  json["scene"] = trial.scene;
  json["recorded"] = audited.recorded;
  if (audited.recorded) {
    json["recorded_status"] = audited.recorded_status;
    json["recorded_distance"] = audited.recorded_distance;
    json["replay_status"] = core::name(audited.replay.status);
    json["replay_distance"] = audited.replay.distance;
    json["same_bits"] = audited.same_bits;
  }
  if (audited.compared) {
    json["reference_status"] = core::name(audited.reference.status);
    json["reference_distance"] = audited.reference.distance;
    json["deviation"] = audited.deviation;
    json["replay_deviation"] = audited.replay_deviation;
    if (audited.nearby.starts > 0) {
      json["nearby"] = json_of(audited.nearby);
      json["disturbed"] = json_of(audited.disturbed);
    }
  }
  json["eq6"] = {{"recorded", champion.champion.eq6},
                 {"replay", champion.replay_eq6},
                 {"reference", champion.reference_eq6},
                 {"deviation", champion.deviation},
                 {"same_bits", champion.same_bits}};
  fmt::print("{}\n", json_line(json));
}

void print_json(const RunAudit& audited, const RunReader& run, const Experiment& experiment) {
  for (const ChampionAudit& champion : audited.champions) {
    for (std::size_t t = 0; t < experiment.trials.size(); ++t) {
      print_trial_json(champion, t, experiment.trials[t]);
    }
  }
  nlohmann::ordered_json json;
  json["run"] = printable(run.file().string());
  json["experiment"] = experiment.name;
  json["champions"] = audited.champions.size();
  json["distinct_champions"] = audited.distinct;
  json["other_bits"] = audited.other_bits;
  json["deviation"] = json_of(audited.recorded);
  json["replay_deviation"] = json_of(audited.replay);
  json["rank_agreement"] = audited.rank_agreement;
  for (std::size_t t = 0; t < experiment.trials.size(); ++t) {
    const TrialSummary& summary = audited.trials[t];
    auto& entry = json["trials"].emplace_back();
    entry["name"] = experiment.trials[t].name;
    entry["deviation"] = json_of(summary.recorded);
    entry["replay_deviation"] = json_of(summary.replay);
    entry["reference_failed"] = summary.reference_failed;
    if (summary.nearby > 0) {
      entry["nearby"] = {{"champions", summary.nearby},
                         {"unpredictable", summary.unpredictable},
                         {"predictable_for", summary.predictable_for},
                         {"growth", summary.growth},
                         {"spread", summary.spread},
                         {"worst_spread", summary.worst_spread},
                         {"disturbed_starts", summary.disturbed_starts},
                         {"disturbed_failed", summary.disturbed_failed},
                         {"disturbed_spread", summary.disturbed_spread},
                         {"worst_disturbed_spread", summary.worst_disturbed_spread},
                         {"luck", json_of(summary.luck)}};
    }
  }
  fmt::print("{}\n", json_line(json));
}

void print_row(const ChampionAudit& champion, const std::string& what, const std::string& status,
               double recorded, bool same_bits, double replay) {
  fmt::print("{:>10} {:>10}  {:<10} {:<12} {:>10.4f} ", champion.champion.generation,
             champion.champion.individual, what, status, recorded);
  fmt::print("{:>10} ", same_bits ? std::string("same bits") : fmt::format("{:.4f}", replay));
}

void print_table(const RunAudit& audited, const Experiment& experiment) {
  fmt::print("{:>10} {:>10}  {:<10} {:<12} {:>10} {:>10} {:>11} {:>11}  {:>9} {:>8} {:>8} {:>11}\n",
             "generation", "individual", "trial", "status", "recorded/d", "replay/d", "reference/d",
             "deviation", "nearby/d", "growth", "parts at", "disturbed/d");
  for (const ChampionAudit& champion : audited.champions) {
    for (std::size_t t = 0; t < experiment.trials.size(); ++t) {
      const TrialAudit& trial = champion.trials[t];
      if (!trial.recorded) continue;
      print_row(champion, experiment.trials[t].name, trial.recorded_status, trial.recorded_distance,
                trial.same_bits, trial.replay.distance);
      if (trial.compared && core::is_failure(trial.reference.status)) {
        fmt::print("{:>11} {:>11}", core::name(trial.reference.status), percent(trial.deviation));
      } else if (trial.compared) {
        fmt::print("{:>11.4f} {:>11}", trial.reference.distance, percent(trial.deviation));
      }
      if (trial.nearby.starts > 0) {
        fmt::print("  {:>9.1e} {:>8.1e} {:>8} {:>11.1e}", trial.nearby.spread, trial.nearby.growth,
                   trial.nearby.parted ? fmt::format("{:.1f}", trial.nearby.predictable_for)
                                       : std::string("never"),
                   trial.disturbed.spread);
      }
      fmt::print("\n");
    }
    print_row(champion, "eq 6", "", champion.champion.eq6, champion.same_bits, champion.replay_eq6);
    fmt::print("{:>11.4f} {:>11}\n", champion.reference_eq6, percent(champion.deviation));
  }
}

void print_range(const std::string& what, const DeviationRange& range) {
  if (range.count == 0) {
    fmt::print("{:<24} nothing to compare\n", what);
    return;
  }
  fmt::print("{:<24} worst {}, median of the sizes {:.3f} %, median {}\n", what,
             percent(range.worst), 100 * range.median, percent(range.bias));
}

void print_trust(const RunAudit& audited) {
  const bool other = audited.other_bits > 0;
  fmt::print("trust: ");
  if (other) {
    fmt::print(
        "the record is not what this program computes, so its numbers stand unconfirmed; of what "
        "this program computes, ");
  }
  fmt::print(
      "the reference confirms eq 6 of {} of {} champions within 1 %, of {} within 10 %; where it "
      "does not, or where 1e-3 d moves the distance, a fitness is one throw of several the same "
      "body can make\n",
      confirmed_within(audited, 0.01, other), audited.champions.size(),
      confirmed_within(audited, 0.1, other));
}

void print_summary(const RunAudit& audited, const Experiment& experiment) {
  const auto shown = static_cast<int>(audited.champions.size());
  fmt::print(
      "\n{} of {} distinct champions{}; reference: double precision, a quarter of the step\n",
      shown, audited.distinct, shown < audited.distinct ? ", the best by eq 6" : "");
  if (audited.other_bits == 0) {
    fmt::print("every replay gives the recorded bits\n");
  } else {
    fmt::print(
        "WARNING: {} of {} replays do not give the recorded numbers: the run was made by another "
        "version of the program, or its record was changed\n",
        audited.other_bits, shown);
  }
  print_range("recorded eq 6", audited.recorded);
  if (audited.other_bits > 0) print_range("replayed eq 6", audited.replay);
  for (std::size_t t = 0; t < experiment.trials.size(); ++t) {
    const TrialSummary& trial = audited.trials[t];
    const std::string& name = experiment.trials[t].name;
    print_range("recorded " + name, trial.recorded);
    if (audited.other_bits > 0) print_range("replayed " + name, trial.replay);
    if (trial.reference_failed > 0) {
      fmt::print("{}: {} champions fail in the reference\n", name, trial.reference_failed);
    }
    if (trial.nearby > 0) {
      fmt::print(
          "{}: starts 1e-6 d apart differ in distance by {:.2g} % in the median, {:.2g} % at "
          "worst; "
          "in the median they grow apart {:.2g} times; {} of {} gaits part by 1 % of the distance "
          "before the end{}\n",
          name, 100 * trial.spread, 100 * trial.worst_spread, trial.growth, trial.unpredictable,
          trial.nearby,
          trial.unpredictable > 0
              ? fmt::format(", in the median after {:.0f} time units", trial.predictable_for)
              : "");
      fmt::print(
          "{}: starts 1e-3 d apart differ in distance by {:.2g} % in the median, {:.2g} % at "
          "worst; the distance is {} of their mean in the median (ahead: luck that was selected)\n",
          name, 100 * trial.disturbed_spread, 100 * trial.worst_disturbed_spread,
          trial.luck.bias < 0 ? fmt::format("{:.2g} % short", -100 * trial.luck.bias)
                              : fmt::format("{:.2g} % ahead", 100 * trial.luck.bias));
      if (trial.disturbed_failed > 0) {
        fmt::print("{}: {} of {} starts 1e-3 d away end in a failure\n", name,
                   trial.disturbed_failed, trial.disturbed_starts);
      }
    }
  }
  fmt::print("order of the champions: Kendall's tau of recorded and reference eq 6 {:.3f}\n",
             audited.rank_agreement);
  print_trust(audited);
}

std::function<void(int, int)> progress_of(const char* what) {
  if (isatty(STDERR_FILENO) == 0) return {};
  return [what](int done, int all) {
    tell("\r{} of {} {}{}", done, all, what, done == all ? "\n" : "");
  };
}

void print_map(const MapAudit& audited, int starts) {
  fmt::print("{:>8} {:>10} {:>10} {:>11}\n", "niche", "individual", "recorded/d", "corrected/d");
  for (const EliteAudit& elite : audited.elites) {
    fmt::print("{:>8} {:>10} {:>10.4f} {:>11.4f}\n", elite.niche, elite.individual, elite.recorded,
               elite.corrected);
  }
  fmt::print(
      "\n{} of {} niches filled; QD score {:.6g}, corrected {:.6g} ({}), the mean of {} fresh "
      "starts "
      "of every elite; {} of {} elites ({:.1f} %) fall below half of what they entered with\n",
      audited.elites.size(), audited.niches, audited.qd_score, audited.corrected,
      percent(relative_deviation(audited.corrected, audited.qd_score)), starts, audited.fallen,
      audited.elites.size(), 100.0 * audited.fallen / static_cast<double>(audited.elites.size()));
}

void print_map_json(const MapAudit& audited, const RunReader& run, int starts) {
  for (const EliteAudit& elite : audited.elites) {
    const nlohmann::ordered_json json = {{"niche", elite.niche},
                                         {"individual", elite.individual},
                                         {"recorded", elite.recorded},
                                         {"corrected", elite.corrected}};
    fmt::print("{}\n", json_line(json));
  }
  const nlohmann::ordered_json json = {{"run", printable(run.file().string())},
                                       {"filled", audited.elites.size()},
                                       {"niches", audited.niches},
                                       {"starts", starts},
                                       {"qd_score", audited.qd_score},
                                       {"corrected_qd_score", audited.corrected},
                                       {"fallen_below_half", audited.fallen}};
  fmt::print("{}\n", json_line(json));
}

void audit_map(const Arguments& given) {
  const RunReader run(given.run);
  EliteAuditOptions options;
  options.starts = given.elite_starts;
  options.displacement = given.options.disturbance;
  options.threads = given.options.threads;
  const MapAudit audited = audit_elites(run, options, progress_of("starts"));
  if (given.json) {
    print_map_json(audited, run, options.starts);
  } else {
    print_map(audited, options.starts);
  }
}

void audit_command(const Arguments& given) {
  if (given.elite_starts > 0) {
    audit_map(given);
    return;
  }
  const RunReader run(given.run);
  const Experiment experiment = run.experiment();
  const std::function<void(int, int)> progress = progress_of("trials");
  const RunAudit audited = audit(run, given.options, progress);
  if (given.json) {
    print_json(audited, run, experiment);
  } else {
    print_table(audited, experiment);
    print_summary(audited, experiment);
  }
}

}  // namespace

void add_audit_command(CLI::App& app) {
  const auto given = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "audit",
      "Says how far the distances of a run can be trusted: simulates its champions again, by the "
      "same program (which must give the same bits) and by the reference in double precision at a "
      "quarter of the step; on land also from nearby starts. A champion of a trial with starts of "
      "its own is replayed from those of its generation. A deviation is relative to the larger "
      "distance, above 0 where more was recorded than the reference confirms.");
  command->add_option("RUN", given->run, "directory of a run, or its run.db")->required();
  command
      ->add_option("--champions", given->options.champions,
                   "At most so many distinct champions: the best by eq 6")
      ->check(integer_from(1, 1000000))
      ->option_text("N [50]");
  command->add_option("--every", given->options.every, "Only generations divisible by K")
      ->check(integer_from(1, 1000000))
      ->option_text("K [1]");
  command->add_option("--from", given->options.from, "Only generations from this one on")
      ->check(integer_from(0, 100000000))
      ->option_text("N [0]");
  command
      ->add_option("--nearby", given->options.nearby_starts,
                   "Starts 1e-6 d away, and as many 1e-3 d away, per champion on land")
      ->check(integer_from(0, 1000))
      ->option_text("N [4]");
  command->add_flag("--nearby-in-water", given->options.nearby_in_water,
                    "Nearby starts in scenes without ground as well, which forget most of them");
  command
      ->add_option("--elites", given->elite_starts,
                   "Of a run of map-elites, instead of champions: every elite again from so many "
                   "starts that it never had, and the QD score that remains")
      ->check(integer_from(1, 1000))
      ->option_text("N");
  command->add_option("--threads", given->options.threads, "Threads; 0 for all there are")
      ->check(integer_from(0, 4096))
      ->option_text("N [0]");
  command->add_flag("--json", given->json,
                    "One JSON object per champion and trial, or elite, then one for the run");
  command->callback([given] { audit_command(*given); });
}

}  // namespace metamorph::evolve
