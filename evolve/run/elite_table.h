#pragma once

#include <cstdint>
#include <vector>

#include "metamorph/genome.h"

namespace metamorph::evolve {

class Database;
class Integrity;

/// Who holds a niche of map-elites.
struct RecordedElite {
  int niche = 0;
  std::int64_t individual = 0;
  double quality = 0;  ///< eq 6 that it entered with
  Genome genome;
};

/// A map at the end of what is recorded of its run.
struct RecordedMap {
  int niches = 0;
  std::vector<RecordedElite> elites;  ///< by niche; of those that are filled
};

/// Reads it, after comparing its tables with their digests. Throws InputError if the run has no
/// elites.
RecordedMap read_elites(Database& database, Integrity& integrity);

}  // namespace metamorph::evolve
