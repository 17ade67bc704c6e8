#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "evolve/experiment/experiment.h"
#include "metamorph/genome.h"

namespace metamorph::evolve {

class Database;
class Integrity;

/// What a map is spread along.
struct MapAxis {
  std::string name;
  double low = 0, high = 1;  ///< its ends
  int bins = 0;              ///< 0: a map of centres
};

/// Who holds a niche of map-elites.
struct RecordedElite {
  int niche = 0;
  std::vector<double> centre;  ///< [axes] of the niche
  std::int64_t individual = 0;
  double quality = 0;  ///< eq 6 that it entered with
  Genome genome;
};

/// A map at the end of what is recorded of its run.
struct RecordedMap {
  int niches = 0;
  std::vector<MapAxis> axes;
  std::vector<RecordedElite> elites;  ///< by niche; of those that are filled
};

/// Reads it, after comparing its tables with their digests. Throws InputError if the run has no
/// elites.
RecordedMap read_elites(Database& database, Integrity& integrity, const Experiment& experiment);

}  // namespace metamorph::evolve
