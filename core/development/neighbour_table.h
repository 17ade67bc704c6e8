#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/cell_mechanics.h"
#include "metamorph/body.h"

namespace metamorph::core {

/// Each cell's linked neighbours, ascending, in the arrangement that the mechanics kernel reads,
/// and changed in place: links come and go one by one. Lane l of group g is cell g * cell_lanes +
/// l; its neighbours lie one slot apart, and what is left of its slots names the cell itself.
class NeighbourTable {
 public:
  /// The neighbours of one cell.
  class List {
   public:
    struct Iterator {
      const std::uint32_t* at;
      int record_bits;
      int operator*() const { return static_cast<int>(*at >> record_bits); }
      Iterator& operator++() {
        at += kernels::cell_lanes;
        return *this;
      }
      bool operator!=(const Iterator& other) const { return at != other.at; }
    };
    List() = default;
    List(const std::uint32_t* first, int count, int record_bits)
        : first_(first), count_(count), record_bits_(record_bits) {}
    Iterator begin() const { return {first_, record_bits_}; }
    Iterator end() const { return {first_ + count_ * kernels::cell_lanes, record_bits_}; }
    int size() const { return count_; }

   private:
    const std::uint32_t* first_ = nullptr;
    int count_ = 0;
    int record_bits_ = 0;
  };

  /// record_bytes: size of the records that the mechanics kernel works on, a power of two.
  explicit NeighbourTable(std::size_t record_bytes)
      : record_bits_(std::countr_zero(record_bytes)) {}

  /// So many cells, none of them linked.
  void reset(Index cells);
  /// Adds cells without links at the end.
  void grow(Index cells);
  void link(Index i, Index j) {
    insert(i, j);
    insert(j, i);
  }
  /// Removes a link that is there.
  void unlink(Index i, Index j) {
    erase(i, j);
    erase(j, i);
  }

  Index cell_count() const { return static_cast<Index>(degree_.size()); }
  List of(Index cell) const {
    return {slots_.data() + place(cell), degree_[static_cast<std::size_t>(cell)], record_bits_};
  }
  /// i < j, ascending.
  std::vector<std::array<Index, 2>> links() const;
  /// How many cells have no link to a lower one. If it is at most one, the links connect all.
  int lowest_count() const;
  kernels::CellRings rings() const {
    return {static_cast<int>(first_slot_.size()), first_slot_.data(), end_slot_.data(),
            slots_.data()};
  }

 private:
  std::size_t place(Index cell) const {
    const int group = cell / kernels::cell_lanes, lane = cell % kernels::cell_lanes;
    return static_cast<std::size_t>(group * capacity_ * kernels::cell_lanes + lane);
  }
  std::uint32_t offset(Index cell) const {
    return static_cast<std::uint32_t>(cell) << record_bits_;
  }
  void insert(Index cell, Index neighbour);
  void erase(Index cell, Index neighbour);
  void widen();

  int record_bits_;
  int capacity_ = 12;  // slots of each group
  std::vector<int> degree_;
  std::vector<int> first_slot_, end_slot_;  // [groups] see kernels::CellRings
  std::vector<std::uint32_t> slots_;
};

}  // namespace metamorph::core
