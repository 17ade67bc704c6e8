#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "evolve/run/run_reader.h"

namespace metamorph::evolve {

struct EliteAuditOptions {
  int starts = 8;              ///< per elite
  double displacement = 1e-3;  ///< d, of the starts of trials with ground that renew none
  int threads = 0;             ///< 0: all there are
};

/// Who holds a niche at the end of a run, and what is left of it from starts that it never had.
struct EliteAudit {
  int niche = 0;
  std::int64_t individual = 0;
  double recorded = 0;   ///< quality (eq 6) that it entered with
  double corrected = 0;  ///< mean quality over the fresh starts
};

/// A map holds the best throw of all that were made for a niche. Where starts decide a distance it
/// is worth less than it says.
struct MapAudit {
  std::vector<EliteAudit> elites;  ///< by niche
  int niches = 0;
  double qd_score = 0;   ///< as recorded
  double corrected = 0;  ///< QD score of the means, every elite in the niche that it holds
  int fallen = 0;        ///< elites whose mean is below half of what was recorded
};

/// Evaluates every elite of a run of map-elites again, `starts` times: where a trial has ground
/// from starts that no generation of the run had, elsewhere as it was. `progress`, if set, is
/// called with the number of rounds done and to do. The same result for any number of threads.
/// Throws InputError if the run has no elites.
MapAudit audit_elites(const RunReader& run, const EliteAuditOptions& options,
                      const std::function<void(int, int)>& progress = {});

}  // namespace metamorph::evolve
