#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "evolve/experiment/experiment.h"
#include "evolve/genetics/genome.h"
#include "evolve/run/fingerprint.h"
#include "evolve/search/search.h"
#include "metamorph/extraction.h"

namespace metamorph::evolve {

/// The embryo behind a trial: what figures 15 to 18 count. All zero if the trial was not run.
struct StageCounts {
  int cells = 0;    ///< alive at the stage end
  int created = 0;  ///< born up to then, founder included
  int died = 0;
};

/// All that is known of an individual after its evaluation.
struct Evaluated {
  Evaluation evaluation;
  std::vector<StageCounts> stages;  ///< [trials]
};

/// Where the seconds of an evaluation went.
struct EvaluationSeconds {
  double develop = 0, extract = 0, locomotion = 0;
};

/// What a check of links has compared (core/development/link_check.h).
struct CheckedLinks {
  std::int64_t developments = 0, renewals = 0, links = 0;
};

/// How much of a generation was computed, and how much was known already. Every start counts.
struct EvaluationWork {
  std::int64_t individuals = 0;  ///< networks that were to be developed
  std::int64_t developed = 0;    ///< of them: developed
  std::int64_t bodies = 0;       ///< bodies that were to be simulated in a scene, from a start
  std::int64_t simulated = 0;    ///< of them: simulated
  EvaluationWork& operator+=(const EvaluationWork& other);
};

/// Evaluates generations: genomes to networks, embryos, bodies, outcomes, each step one batch.
///
/// Identical work is done once: of equal networks (copies, or genomes that differ in what does not
/// count) one is developed, of equal bodies in the same scene (networks may differ and grow the
/// same) one is simulated, and what the previous call computed is not computed again. As results
/// depend on network, body, scene and experiment alone, this changes no bit of them. It is told by
/// fingerprints, and only the last call's are kept: less than 2 KB per individual of one start.
/// (Work that was done earlier than that comes back too seldom to be kept: 0.1 to 0.6 % of
/// locomotion in runs of 100 to 200 generations.)
///
/// A trial of several starts (starts.h) is as many such simulations, each of a displaced copy of
/// the body and known by that copy's fingerprint: starts that every generation has are known
/// again, renewed ones are not. Where a trial renews its starts the bodies are kept as well, some
/// 60 KB per individual, so that what lives on is moved again without being developed again.
class Evaluator {
 public:
  /// The experiment must outlive the evaluator. `threads` 0: all. With `checked` every development
  /// is checked, counted there, and a difference thrown as std::runtime_error.
  Evaluator(const Experiment& experiment, int threads, CheckedLinks* checked = nullptr);

  /// Evaluates the trials t with run_trial[t] != 0, and develops no further than they need. The
  /// generation decides the starts of trials that renew them, and nothing else.
  std::vector<Evaluated> evaluate(std::span<const Genome> genomes,
                                  const std::vector<std::uint8_t>& run_trial, int generation,
                                  EvaluationSeconds& seconds);

  /// All trials of one genome, as evaluate() has them in that generation.
  Evaluated evaluate_fully(const Genome& genome, int generation, EvaluationSeconds& seconds) const;

  /// Of the last call of evaluate().
  const EvaluationWork& work() const { return work_; }

 private:
  /// A body, as it starts, in a scene of the experiment.
  struct Task {
    Fingerprint body;
    const core::Scene* scene;
    bool operator==(const Task&) const = default;
  };
  struct TaskHash {
    std::size_t operator()(const Task& task) const;
  };
  using Outcomes = std::unordered_map<Task, core::Outcome, TaskHash>;

  struct Known {
    Evaluated result;
    /// [distinct stages of the trials that run, ascending]; empty once its tasks are final.
    std::vector<core::Extraction> bodies;
    std::vector<std::vector<Task>> tasks;  ///< [trials][starts] that give its outcomes; of a trial
                                           ///< without a body none
  };
  /// A task that is to be simulated, and where its body comes from.
  struct Run {
    Task task;
    const core::Body* body;
    const Trial* trial;
    int start;
  };

  /// Develops networks that are all different, compiled from these genomes. No outcome yet.
  std::vector<Known> grow(std::span<const core::Network> networks,
                          std::span<const Genome* const> genomes,
                          const std::vector<std::uint8_t>& run_trial, EvaluationSeconds& seconds,
                          EvaluationWork& work) const;
  /// Runs the bodies of `all` from the starts of a generation, as far as no outcome is known, and
  /// completes their results. Returns the outcomes of all their tasks.
  Outcomes run_bodies(std::span<Known* const> all, int generation, EvaluationSeconds& seconds,
                      EvaluationWork& work) const;
  std::vector<Task> tasks_of(const core::Body& body, const Trial& trial, int generation) const;
  void simulate(std::span<const Run> runs, int generation, Outcomes& outcomes) const;

  const Experiment& experiment_;
  int threads_;
  CheckedLinks* checked_;
  bool renews_;  ///< a trial renews its starts
  EvaluationWork work_;
  // Of the last call, and the trials it ran.
  std::unordered_map<Fingerprint, Known, FingerprintHash> known_;
  Outcomes outcomes_;
  std::vector<std::uint8_t> known_trials_;
};

}  // namespace metamorph::evolve
