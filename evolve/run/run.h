#pragma once

#include <functional>
#include <vector>

#include "evolve/run/record.h"
#include "evolve/run/reporter.h"

namespace metamorph::evolve {

struct RunOptions {
  int threads = 0;                        ///< 0: all
  std::function<bool()> stop;             ///< asked after every generation; may be empty
  std::vector<Reporter*> reporters;       ///< borrowed
  CheckedLinks* checked_links = nullptr;  ///< borrowed, see Evaluator; changes nothing in the run
};

/// Evolves from the record's checkpoint to the experiment's last generation: ask, compile,
/// evaluate, tell, record, again and again. Neither prints nor draws. The same bits for any thread
/// count, and however often it was interrupted and resumed.
RunSummary run(Record& record, const RunOptions& options);

/// Throws InputError if a run of this experiment that has done so many generations cannot go on to
/// `generations` and be the same as one that was to have that number from the start.
void check_new_generations(const Experiment& experiment, int done, int generations);

}  // namespace metamorph::evolve
