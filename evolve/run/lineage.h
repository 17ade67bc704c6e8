#pragma once

#include <cstdint>
#include <map>
#include <vector>

namespace metamorph::evolve {

class Database;

struct GenerationFitness {
  double best = 0, mean = 0;  ///< eq 6, d
};

/// An individual as the record knows it; of individuals that are no champions there is no genome.
struct Ancestor {
  int generation = 0;        ///< in which it was born
  double eq6 = 0;            ///< d, then
  std::int64_t parent = -1;  ///< of two the fitter one by eq 6; -1: none
  std::int64_t other = -1;   ///< the other one; -1: none
};

/// By generation.
std::vector<GenerationFitness> fitness_of(Database& record);

/// The individuals named, their parents (of two the fitter one), those of these, and so on; by
/// individual.
std::map<std::int64_t, Ancestor> ancestors_of(Database& record,
                                              const std::vector<std::int64_t>& individuals);

}  // namespace metamorph::evolve
