#pragma once

#include <functional>
#include <vector>

#include "evolve/experiment/experiment.h"
#include "evolve/run/nearby_starts.h"
#include "evolve/run/run_reader.h"
#include "metamorph/outcome.h"

namespace metamorph::evolve {

struct AuditOptions {
  int champions = 50;            ///< at most so many distinct ones: the best by recorded eq 6
  int every = 1;                 ///< only generations divisible by this
  int from = 0;                  ///< no generation before this
  int nearby_starts = 4;         ///< per champion and trial with ground; 0: none
  bool nearby_in_water = false;  ///< and per trial without
  double displacement = 1e-6;    ///< d, of those starts: does the gait forget it or blow it up?
  double disturbance = 1e-3;     ///< d, of as many other starts: does the distance bear it?
  int threads = 0;               ///< 0: all there are
};

/// (distance - reference) over the larger of the two: above 0 if the distance is more than the
/// reference confirms, within [-1, 1], 0 if both are 0.
double relative_deviation(double distance, double reference);

/// One trial of a champion: what was recorded, what this program makes of it now, and what the
/// equations of motion give.
struct TrialAudit {
  bool recorded = false;         ///< the trial was run; else nothing below says anything
  std::string recorded_status;   ///< name of a core::Status
  double recorded_distance = 0;  ///< d
  core::Outcome replay;          ///< the same evaluation once more
  bool same_bits = false;        ///< status and distance of the replay are those recorded
  bool compared = false;         ///< there is a body, and neither record nor replay is a failure;
                                 ///< else no reference was run
  core::Outcome reference;  ///< of the same starts, in double precision at a quarter of the step
  double deviation = 0;     ///< relative_deviation() of the recorded distance
  double replay_deviation = 0;  ///< and of the replay's
  NearbyStarts nearby;          ///< around the body as it is, where there is ground (or with
                                ///< options.nearby_in_water): by options.displacement
  NearbyStarts disturbed;       ///< likewise by options.disturbance
};

struct ChampionAudit {
  Champion champion;               ///< as recorded, of the first generation that has it
  std::vector<TrialAudit> trials;  ///< [trials] of the experiment
  double replay_eq6 = 0;
  double reference_eq6 = 0;  ///< a trial that was not compared counts as in the replay
  bool same_bits = false;    ///< of eq 6 and of every trial
  double deviation = 0;      ///< relative_deviation() of the recorded eq 6
  double replay_deviation = 0;
};

/// The middle of some signed deviations and the one farthest from 0.
struct DeviationRange {
  int count = 0;
  double median = 0;  ///< of the sizes
  double worst = 0;   ///< the farthest from 0, with its sign
  double bias = 0;    ///< median with sign: above 0 if distances tend to be too long
};

/// What the champions say together about one trial.
struct TrialSummary {
  DeviationRange recorded, replay;
  int reference_failed = 0;    ///< the reference ended in a failure where the record did not
  int unpredictable = 0;       ///< champions whose nearby starts part by 1 % before the end
  int nearby = 0;              ///< champions with nearby starts
  double predictable_for = 0;  ///< median of those that part, time units
  double growth = 0;           ///< median
  double spread = 0;           ///< median, relative to the distance
  double worst_spread = 0;
  double disturbed_spread = 0;  ///< the same two for NearbyStarts by options.disturbance
  double worst_disturbed_spread = 0;
  int disturbed_starts = 0;
  int disturbed_failed = 0;  ///< of them, ended in a failure; in no other number here
  DeviationRange luck;  ///< of the replay from the mean of the disturbed starts: bias above 0 if
                        ///< the search picked bodies for how they happened to start
};

struct RunAudit {
  std::vector<ChampionAudit> champions;  ///< in order of their generation
  int distinct = 0;                      ///< champions there were to choose from
  int other_bits = 0;                    ///< champions whose replay is not what was recorded
  DeviationRange recorded, replay;       ///< of eq 6
  double rank_agreement = 1;             ///< kendall_tau() of recorded and reference eq 6
  std::vector<TrialSummary> trials;      ///< [trials] of the experiment
};

/// Kendall's tau-b of two lists of one length: 1 the same order, -1 the opposite; 1 where there is
/// no pair to compare.
double kendall_tau(const std::vector<double>& a, const std::vector<double>& b);

/// Champions whose eq 6 the reference confirms within a share of it: the recorded one, or with
/// `replay` that of the replay.
int confirmed_within(const RunAudit& audited, double share, bool replay);

DeviationRange range_of(std::vector<double> deviations);

/// Replays the champions of a run, each from the starts of its generation, and compares them with
/// the reference simulation. A champion that stays over generations with the same results counts
/// once. `progress`, if set, is called with the number of
/// trials done and to do, from one thread at a time. The same result for any number of threads.
/// Throws InputError if the record is damaged or has no champion that was asked for.
RunAudit audit(const RunReader& run, const AuditOptions& options,
               const std::function<void(int, int)>& progress = {});

}  // namespace metamorph::evolve
