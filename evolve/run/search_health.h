#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace metamorph::evolve {

class Database;
class Integrity;

/// What the tables of a search say of its health. What a search has no table for stays empty.
struct SearchHealth {
  /// Children by how they came to be, of the last generations.
  struct Origin {
    std::string origin;
    std::int64_t children = 0, better = 0, dead = 0;
  };
  struct Archive {
    std::int64_t size = 0, copies = 0;  ///< copies: of all generations
    double threshold = 0;               ///< d
  };
  std::optional<std::int64_t> species;  ///< of the last generation
  std::int64_t founded = 0;
  std::vector<std::pair<std::string, std::int64_t>> ended;  ///< why, how many
  std::vector<Origin> origins;
  std::optional<Archive> archive;
  struct Map {
    std::int64_t filled = 0, niches = 0;
    double qd_score = 0;
  };
  struct Front {
    std::int64_t size = 0;
    double hypervolume = 0;
  };
  std::optional<Map> map;                                 ///< after the last generation
  std::optional<Front> front;                             ///< likewise
  std::vector<std::pair<std::string, double>> behaviour;  ///< trial, share of the variance, last

  static constexpr int recent = 10;  ///< generations that the children are counted over
};

/// Of tables that are what was written; throws InputError of others.
SearchHealth search_health(Database& record, Integrity& integrity);

}  // namespace metamorph::evolve
