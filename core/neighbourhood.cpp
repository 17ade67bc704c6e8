#include <algorithm>
#include <cstddef>

#include "core/neighbourhood_detail.h"

namespace metamorph::core {

void Neighbourhood::renew(std::span<const double> x, std::span<const double> y,
                          std::span<const Index> previous, double link_limit) {
  triangulation_.update(x, y, previous);
  const auto& edges = triangulation_.edges();
  if (!triangulation_.changed() && selection_.still_holds(x, y, link_limit, edges)) return;
  selection_.select(x, y, link_limit, edges, links_);
  list_neighbours(x.size());
  fill_slots(static_cast<int>(x.size()));
}

void Neighbourhood::list_neighbours(std::size_t cells) {
  start_.assign(cells + 1, 0);
  for (const auto& [i, j] : links_) {
    ++start_[static_cast<std::size_t>(i)];
    ++start_[static_cast<std::size_t>(j)];
  }
  int end = 0;
  for (int& start : start_) {
    const int degree = start;
    start = end;
    end += degree;
  }
  // Links ascend, so a cell meets its lower neighbours first, then its higher ones, each in order.
  // Filling moves every start to its list's end, which is the next list's start.
  neighbour_.resize(static_cast<std::size_t>(end));
  for (const auto& [i, j] : links_) {
    neighbour_[static_cast<std::size_t>(start_[static_cast<std::size_t>(i)]++)] = j;
    neighbour_[static_cast<std::size_t>(start_[static_cast<std::size_t>(j)]++)] = i;
  }
  std::copy_backward(start_.begin(), start_.end() - 1, start_.end());
  start_[0] = 0;
}

void Neighbourhood::fill_slots(int cells) {
  constexpr int lanes = kernels::cell_lanes;
  const int groups = (cells + lanes - 1) / lanes;
  const auto degree = [this](int i) {
    return start_[static_cast<std::size_t>(i) + 1] - start_[static_cast<std::size_t>(i)];
  };
  first_slot_.assign(1, 0);
  for (int g = 0; g < groups; ++g) {
    int slots = 0;
    for (int i = g * lanes; i < std::min(cells, (g + 1) * lanes); ++i) {
      slots = std::max(slots, degree(i));
    }
    first_slot_.push_back(first_slot_.back() + slots);
  }
  slot_neighbour_.resize(static_cast<std::size_t>(first_slot_.back() * lanes));
  for (int i = 0; i < groups * lanes; ++i) {
    const auto g = static_cast<std::size_t>(i / lanes);
    const int linked = i < cells ? degree(i) : 0;
    auto at = static_cast<std::size_t>(first_slot_[g] * lanes + i % lanes);
    for (int s = 0; s < linked; ++s, at += lanes) {
      slot_neighbour_[at] =
          static_cast<std::uint32_t>(of(i)[static_cast<std::size_t>(s)]) * record_bytes_;
    }
    for (int s = first_slot_[g] + linked; s < first_slot_[g + 1]; ++s, at += lanes) {
      slot_neighbour_[at] = static_cast<std::uint32_t>(i) * record_bytes_;
    }
  }
}

}  // namespace metamorph::core
