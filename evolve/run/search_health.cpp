#include "evolve/run/search_health.h"

#include <algorithm>
#include <string>
#include <vector>

#include "evolve/run/integrity.h"
#include "evolve/run/sqlite.h"

namespace metamorph::evolve {
namespace {

/// Which tables there are; those that are looked at are checked.
class Tables {
 public:
  Tables(Database& record, Integrity& integrity)
      : known_(counted_tables(record)), integrity_(integrity) {}
  bool have(const std::string& table) {
    if (std::find(known_.begin(), known_.end(), table) == known_.end()) return false;
    integrity_.check_table(table);
    return true;
  }

 private:
  std::vector<std::string> known_;
  Integrity& integrity_;
};

}  // namespace

SearchHealth search_health(Database& record, Integrity& integrity) {
  SearchHealth health;
  Tables tables(record, integrity);
  if (tables.have("populations")) {
    Statement last(record, "SELECT species FROM populations ORDER BY generation DESC LIMIT 1");
    if (last.step()) health.species = last.integer(0);
  }
  if (tables.have("species_changes")) {
    Statement count(record, "SELECT change, count(*) FROM species_changes GROUP BY change");
    while (count.step()) {
      if (count.text(0) == "founded") {
        health.founded = count.integer(1);
      } else {
        health.ended.emplace_back(count.text(0), count.integer(1));
      }
    }
  }
  if (tables.have("origins")) {
    Statement sum(record,
                  "SELECT origin, sum(children), sum(better), sum(dead) FROM origins WHERE "
                  "generation > (SELECT max(generation) FROM origins) - ? GROUP BY origin "
                  "ORDER BY 2 DESC");
    sum.bind(SearchHealth::recent);
    while (sum.step()) {
      health.origins.push_back({sum.text(0), sum.integer(1), sum.integer(2), sum.integer(3)});
    }
  }
  if (tables.have("archive_sizes")) {
    Statement last(record,
                   "SELECT archive_size, archive_threshold, (SELECT sum(archive_copies) FROM "
                   "archive_sizes) FROM archive_sizes ORDER BY generation DESC LIMIT 1");
    if (last.step()) health.archive = {last.integer(0), last.integer(2), last.real(1)};
  }
  if (tables.have("qd")) {
    Statement last(record,
                   "SELECT filled, niches, qd_score FROM qd ORDER BY generation DESC LIMIT 1");
    if (last.step()) health.map = {last.integer(0), last.integer(1), last.real(2)};
  }
  if (tables.have("fronts")) {
    Statement last(record,
                   "SELECT front_size, hypervolume FROM fronts ORDER BY generation DESC LIMIT 1");
    if (last.step()) health.front = {last.integer(0), last.real(1)};
  }
  if (tables.have("behaviour_shares")) {
    Statement last(record,
                   "SELECT trial, share FROM behaviour_shares WHERE generation = (SELECT "
                   "max(generation) FROM behaviour_shares) ORDER BY objective");
    while (last.step()) health.behaviour.emplace_back(last.text(0), last.real(1));
  }
  return health;
}

}  // namespace metamorph::evolve
