#include <algorithm>

#include "core/development/neighbour_table.h"

namespace metamorph::core {
namespace {

constexpr int lanes = kernels::cell_lanes;

}  // namespace

void NeighbourTable::reset(Index cells) {
  degree_.clear();
  first_slot_.clear();
  end_slot_.clear();
  slots_.clear();
  grow(cells);
}

void NeighbourTable::grow(Index cells) {
  degree_.resize(static_cast<std::size_t>(cells), 0);
  const auto groups = static_cast<std::size_t>((cells + lanes - 1) / lanes);
  while (first_slot_.size() < groups) {
    const int group = static_cast<int>(first_slot_.size());
    first_slot_.push_back(group * capacity_);
    end_slot_.push_back(group * capacity_);
    for (int entry = 0; entry < capacity_ * lanes; ++entry) {
      slots_.push_back(offset(group * lanes + entry % lanes));
    }
  }
}

/// Gives every group twice the slots.
void NeighbourTable::widen() {
  const std::vector<std::uint32_t> before = slots_;
  const auto old_size = static_cast<std::ptrdiff_t>(capacity_ * lanes);
  capacity_ *= 2;
  slots_.resize(2 * before.size());
  for (std::size_t g = 0; g < first_slot_.size(); ++g) {
    const int group = static_cast<int>(g);
    const int slots = end_slot_[g] - first_slot_[g];
    first_slot_[g] = group * capacity_;
    end_slot_[g] = first_slot_[g] + slots;
    auto to = slots_.begin() + 2 * group * old_size;
    to = std::copy_n(before.begin() + group * old_size, old_size, to);
    for (int entry = 0; entry < old_size; ++entry) *to++ = offset(group * lanes + entry % lanes);
  }
}

void NeighbourTable::insert(Index cell, Index neighbour) {
  int& degree = degree_[static_cast<std::size_t>(cell)];
  if (degree == capacity_) widen();
  const auto group = static_cast<std::size_t>(cell / lanes);
  std::uint32_t* const first = slots_.data() + place(cell);
  const std::uint32_t added = offset(neighbour);
  int slot = degree++;
  for (; slot > 0 && first[(slot - 1) * lanes] > added; --slot) {
    first[slot * lanes] = first[(slot - 1) * lanes];
  }
  first[slot * lanes] = added;
  end_slot_[group] = std::max(end_slot_[group], first_slot_[group] + degree);
}

void NeighbourTable::erase(Index cell, Index neighbour) {
  int& degree = degree_[static_cast<std::size_t>(cell)];
  const auto group = static_cast<std::size_t>(cell / lanes);
  std::uint32_t* const first = slots_.data() + place(cell);
  int slot = 0;
  while (first[slot * lanes] != offset(neighbour)) ++slot;
  for (; slot + 1 < degree; ++slot) first[slot * lanes] = first[(slot + 1) * lanes];
  first[slot * lanes] = offset(cell);
  if (first_slot_[group] + degree-- < end_slot_[group]) return;
  const auto begin = degree_.begin() + static_cast<std::ptrdiff_t>(group) * lanes;
  const auto rest = degree_.end() - begin;
  end_slot_[group] =
      first_slot_[group] + *std::max_element(begin, begin + std::min<std::ptrdiff_t>(lanes, rest));
}

std::vector<std::array<Index, 2>> NeighbourTable::links() const {
  std::vector<std::array<Index, 2>> links;
  for (Index i = 0; i < cell_count(); ++i) {
    for (const Index j : of(i)) {
      if (i < j) links.push_back({i, j});
    }
  }
  return links;
}

int NeighbourTable::lowest_count() const {
  int count = 0;
  for (Index i = 0; i < cell_count(); ++i) count += slots_[place(i)] >= offset(i);
  return count;
}

}  // namespace metamorph::core
