#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/links.h"
#include "core/triangulation_repair.h"
#include "kernels/cell_mechanics.h"

namespace metamorph::core {

/// Who is linked to whom in one embryo, in the three forms that development needs: links, each
/// cell's ascending list of neighbours, and the same lists arranged for the mechanics kernel.
class Neighbourhood {
 public:
  /// record_bytes: size of the records that the mechanics kernel works on.
  explicit Neighbourhood(std::size_t record_bytes)
      : record_bytes_(static_cast<std::uint32_t>(record_bytes)) {}

  /// Starts a new embryo.
  void clear() { triangulation_.clear(); }

  /// Renews everything from the centres' positions (finite). previous: see TriangulationRepair.
  void renew(std::span<const double> x, std::span<const double> y, std::span<const Index> previous,
             double link_limit);

  const std::vector<std::array<Index, 2>>& links() const { return links_; }
  std::vector<std::array<Index, 3>> faces() const { return triangulation_.faces(); }

  /// Linked neighbours of a cell, ascending.
  std::span<const int> of(Index cell) const {
    const int* const first = neighbour_.data() + start_[static_cast<std::size_t>(cell)];
    const int* const last = neighbour_.data() + start_[static_cast<std::size_t>(cell) + 1];
    return {first, last};
  }

  kernels::CellRings rings() const {
    return {static_cast<int>(first_slot_.size()) - 1, first_slot_.data(), slot_neighbour_.data()};
  }

 private:
  void list_neighbours(std::size_t cells);
  void fill_slots(int cells);

  std::uint32_t record_bytes_;
  TriangulationRepair triangulation_;
  LinkSelection selection_;
  std::vector<std::array<Index, 2>> links_;
  std::vector<int> start_, neighbour_;  // lists of neighbours, one after the other
  std::vector<int> first_slot_;         // see kernels::CellRings
  std::vector<std::uint32_t> slot_neighbour_;
};

}  // namespace metamorph::core
