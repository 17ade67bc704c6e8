#pragma once

#include <array>
#include <span>
#include <vector>

#include "metamorph/body.h"

namespace metamorph::core {

/// Which Delaunay edges link cells (MODEL section 2, Neighbours): all those not longer than
/// `limit`; then the longer ones in ascending length, ties by cell indices, as far as they join two
/// components. Lengths are compared as squares in double. Reuse one object to save allocations.
class LinkSelection {
 public:
  /// edges: i < j, ascending. links: the chosen edges, ascending. True if none of them is longer
  /// than the limit.
  bool select(std::span<const double> x, std::span<const double> y, double limit,
              std::span<const std::array<Index, 2>> edges,
              std::vector<std::array<Index, 2>>& links);

 private:
  struct LongEdge {
    double square;
    std::array<Index, 2> edge;
  };
  Index root(Index i);
  bool join_components(std::span<const double> x, std::span<const double> y,
                       std::span<const std::array<Index, 2>> edges,
                       std::vector<std::array<Index, 2>>& links);

  std::vector<Index> parent_;
  std::vector<LongEdge> long_edges_;
  std::vector<unsigned char> is_short_;   // [edges]
  std::vector<unsigned char> has_lower_;  // [cells] has a short link to a lower cell
};

}  // namespace metamorph::core
