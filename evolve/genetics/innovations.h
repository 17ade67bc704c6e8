#pragma once

#include <map>
#include <utility>

#include "evolve/genetics/mutation.h"

namespace metamorph::evolve {

/// Gives innovation numbers and node ids to the structural changes of one generation: the same
/// change (a link between the same nodes, a split of a link between the same nodes) gets the same
/// numbers, a new one the next free ones.
class Innovations {
 public:
  /// Borrows the two counters of the population; they are advanced in place.
  Innovations(int& next_innovation, int& next_node);

  /// Carries out a change left by mutate(). An added node gets incoming weight 1 and the split
  /// link's weight outgoing; the split link goes.
  void apply(const StructuralChange& change, const NeatSettings& settings, Genome& genome);

 private:
  struct Split {
    int node, in, out;  // id, innovation numbers
  };
  int link_number(int from, int to);
  Split split_numbers(int from, int to);

  int& next_innovation_;
  int& next_node_;
  std::map<std::pair<int, int>, int> links_;
  std::map<std::pair<int, int>, Split> splits_;
};

}  // namespace metamorph::evolve
