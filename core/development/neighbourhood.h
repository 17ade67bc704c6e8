#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/development/links.h"
#include "core/development/neighbour_table.h"
#include "core/development/triangulation_repair.h"

namespace metamorph::core {

/// Who is linked to whom in one embryo. From one renewal to the next few links come or go: the
/// table of neighbours is patched where an edge of the triangulation is another one or has passed
/// the limit of length, as long as the short edges connect all cells in a way that is easy to see.
/// Else it is filled anew from all edges.
class Neighbourhood {
 public:
  /// record_bytes: see NeighbourTable.
  explicit Neighbourhood(std::size_t record_bytes) : table_(record_bytes) {}

  /// Starts a new embryo.
  void clear() { triangulation_.clear(); }

  /// Renews everything from the centres' positions (finite). previous: see TriangulationRepair.
  void renew(std::span<const double> x, std::span<const double> y, std::span<const Index> previous,
             double link_limit);

  std::vector<std::array<Index, 2>> links() const { return table_.links(); }
  std::vector<std::array<Index, 3>> faces() const { return triangulation_.faces(); }
  NeighbourTable::List of(Index cell) const { return table_.of(cell); }
  kernels::CellRings rings() const { return table_.rings(); }

 private:
  using Edge = std::array<Index, 2>;

  bool patch(double square_limit);
  void make_room(int edges);
  void unlink(int edge);
  void link_if_short(int edge, double square_limit);
  void fill(std::span<const double> x, std::span<const double> y, double link_limit);

  TriangulationRepair triangulation_;
  LinkSelection selection_;
  std::vector<Edge> links_;
  NeighbourTable table_;
  /// The table holds the short edges of the mesh, and them alone.
  bool patchable_ = false;
  std::vector<Edge> ends_;        // [edges] of those that are in the table
  std::vector<double> unlinked_;  // [edges] 1 if not in the table, 0 if it is
  std::vector<std::int32_t> crossed_;
};

}  // namespace metamorph::core
