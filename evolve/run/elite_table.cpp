#include "evolve/run/elite_table.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "evolve/files/input_error.h"
#include "evolve/run/integrity.h"
#include "evolve/search/population_json.h"

namespace metamorph::evolve {

RecordedMap read_elites(Database& database, Integrity& integrity) {
  const std::string file = database.file().string();
  Statement known(database, "SELECT count(*) FROM sqlite_master WHERE name = 'elites'");
  known.step();
  if (known.integer(0) == 0) {
    throw InputError(fmt::format("{}: has no table elites: expected a run of map-elites", file));
  }
  for (const char* table : {"elites", "qd"}) integrity.check_table(table);
  RecordedMap map;
  Statement niches(database, "SELECT niches FROM qd LIMIT 1");
  if (niches.step()) map.niches = static_cast<int>(niches.integer(0));
  // The last row of every niche.
  Statement last(database,
                 "SELECT niche, individual, quality, genome, max(generation) FROM elites GROUP BY "
                 "niche ORDER BY niche");
  while (last.step()) {
    RecordedElite& elite = map.elites.emplace_back();
    elite.niche = static_cast<int>(last.integer(0));
    elite.individual = last.integer(1);
    elite.quality = last.real(2);
    try {
      elite.genome = genome_of(nlohmann::json::parse(last.text(3)));
    } catch (const nlohmann::json::exception& error) {
      throw InputError(fmt::format("{}: elite of niche {}: {}", file, elite.niche, error.what()));
    }
  }
  if (map.elites.empty()) {
    throw InputError(fmt::format("{}: no niche is filled yet: expected one at least", file));
  }
  return map;
}

}  // namespace metamorph::evolve
