#pragma once

// Pictures of many animats: those of several sources, or of several generations of a run.

#include <string>
#include <vector>

#include "evolve/app/rules_options.h"
#include "evolve/view/zoo.h"

namespace metamorph::evolve {

inline constexpr int most_animats = 64;  ///< of one picture

struct ZooOptions {
  std::vector<std::string> sources;
  RulesOptions rules;
  int generation = -1;           ///< of every run; -1: the best of all
  std::vector<int> generations;  ///< of the one run; empty: `count` of them, evenly spread
  int count = 0;                 ///< 0: was not given
  ZooStyle style;
};

/// Of one run the champions of several generations; of several sources an animat each: a run's
/// champion, a genome, a body in the scene asked for. Throws InputError.
Sheet zoo_of(const ZooOptions& options);

/// The champions of several generations of a run. Throws InputError if the source is none.
Sheet history_of(const ZooOptions& options);

}  // namespace metamorph::evolve
