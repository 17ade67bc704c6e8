#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "metamorph/body.h"

// CGAL's own ways to renew a Delaunay triangulation. What they list are its finite edges, in no
// order, which is less than the library's repair does.

namespace metamorph::bench {

using Edges = std::vector<std::array<core::Index, 2>>;

/// A new triangulation, all points inserted at once (CGAL sorts them along a curve).
void cgal_insert(std::span<const double> x, std::span<const double> y, Edges& edges);

/// A triangulation that is kept: points are moved by
/// Delaunay_triangulation_2::move_if_no_collision, the born inserted, the dead removed.
class CgalMoves {
 public:
  CgalMoves();
  ~CgalMoves();

  void clear();
  /// previous[i]: what point i was in the update before; -1 if it was not there.
  void update(std::span<const double> x, std::span<const double> y,
              std::span<const core::Index> previous);
  void list(Edges& edges) const;

 private:
  struct Kept;
  std::unique_ptr<Kept> kept_;
};

}  // namespace metamorph::bench
