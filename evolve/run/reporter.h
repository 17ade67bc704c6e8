#pragma once

#include <filesystem>

#include "evolve/experiment/experiment.h"
#include "evolve/run/checkpoint.h"
#include "evolve/run/generation.h"

namespace metamorph::evolve {

/// A run as it begins or goes on.
struct RunStart {
  const Experiment& experiment;
  const std::filesystem::path& directory;
  int first_generation = 0;  ///< above 0: resumed
  const BestEver& best;      ///< of the generations before; nobody if there are none
};

/// One generation, already safe in the record.
struct GenerationReport {
  const Experiment& experiment;
  const GenerationResult& result;
  const BestEver& best;          ///< by eq 6, up to now
  bool improved = false;         ///< `best` is of this generation
  std::int64_t evaluations = 0;  ///< of bodies in scenes from starts, over the population
  double seconds = 0;
};

/// How a run ended.
struct RunSummary {
  int generations_done = 0;  ///< in the record, earlier sessions included
  bool interrupted = false;  ///< stopped before the last generation
  BestEver best;
  PhaseSeconds seconds;                            ///< of this session
  EvaluationWork work;                             ///< of this session
  std::array<int, core::status_count> statuses{};  ///< of this session
  int near_step_limit = 0;                         ///< evaluations, of this session
};

/// Somebody who wants to know how a run goes. All calls come from the thread that runs it. What a
/// reporter does changes nothing in the run.
class Reporter {
 public:
  virtual ~Reporter() = default;
  virtual void started(const RunStart&) {}
  virtual void generation_done(const GenerationReport&) {}
  virtual void finished(const RunSummary&) {}
};

}  // namespace metamorph::evolve
