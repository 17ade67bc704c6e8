#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "evolve/experiment/experiment.h"
#include "evolve/genetics/genome.h"
#include "evolve/search/search.h"

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

/// What a check of links has compared (core/link_check.h).
struct CheckedLinks {
  std::int64_t developments = 0, renewals = 0, links = 0;
};

/// Evaluates generations: genomes to networks, embryos, bodies, outcomes, each step one batch. A
/// genome that was in the previous call with the same trials (an elite) keeps its result; as a
/// result depends on genome and experiment alone, this changes no bit.
class Evaluator {
 public:
  /// The experiment must outlive the evaluator. `threads` 0: all. With `checked` every development
  /// is checked, counted there, and a difference thrown as std::runtime_error.
  Evaluator(const Experiment& experiment, int threads, CheckedLinks* checked = nullptr);

  /// Evaluates the trials t with run_trial[t] != 0, and develops no further than they need.
  std::vector<Evaluated> evaluate(std::span<const Genome> genomes,
                                  const std::vector<std::uint8_t>& run_trial,
                                  EvaluationSeconds& seconds);

  /// All trials of one genome.
  Evaluated evaluate_fully(const Genome& genome, EvaluationSeconds& seconds) const;

 private:
  struct GenomeHash {
    std::size_t operator()(const Genome& genome) const;
  };

  std::vector<Evaluated> evaluate_new(std::span<const Genome* const> genomes,
                                      const std::vector<std::uint8_t>& run_trial,
                                      EvaluationSeconds& seconds) const;

  const Experiment& experiment_;
  int threads_;
  CheckedLinks* checked_;
  std::unordered_map<Genome, Evaluated, GenomeHash> previous_;
  std::vector<std::uint8_t> previous_trials_;
};

}  // namespace metamorph::evolve
