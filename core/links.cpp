#include "core/links.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <tuple>

namespace metamorph::core {

namespace {

double squared_length(std::span<const double> x, std::span<const double> y,
                      const std::array<Index, 2>& edge) {
  const auto i = static_cast<std::size_t>(edge[0]), j = static_cast<std::size_t>(edge[1]);
  const double dx = x[j] - x[i], dy = y[j] - y[i];
  return dx * dx + dy * dy;
}

}  // namespace

Index LinkSelection::root(Index i) {
  Index* const parent = parent_.data();
  while (parent[i] != i) {
    parent[i] = parent[parent[i]];
    i = parent[i];
  }
  return i;
}

void LinkSelection::select(std::span<const double> x, std::span<const double> y, double limit,
                           std::span<const std::array<Index, 2>> edges,
                           std::vector<std::array<Index, 2>>& links) {
  parent_.resize(x.size());
  std::iota(parent_.begin(), parent_.end(), 0);
  long_edges_.clear();
  is_short_.clear();
  links.clear();
  std::size_t components = x.size();
  const auto join = [&](const std::array<Index, 2>& edge) {
    const Index a = root(edge[0]), b = root(edge[1]);
    if (a == b) return false;
    parent_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    --components;
    return true;
  };
  for (const auto& edge : edges) {
    const double square = squared_length(x, y, edge);
    is_short_.push_back(square <= limit * limit);
    if (square <= limit * limit) {
      links.push_back(edge);
      join(edge);
    } else {
      long_edges_.push_back({square, edge});
    }
  }
  short_ones_suffice_ = components <= 1;
  if (short_ones_suffice_) return;

  std::sort(long_edges_.begin(), long_edges_.end(), [](const LongEdge& a, const LongEdge& b) {
    return std::tie(a.square, a.edge) < std::tie(b.square, b.edge);
  });
  const auto short_links = static_cast<std::ptrdiff_t>(links.size());
  for (const LongEdge& candidate : long_edges_) {
    if (join(candidate.edge)) links.push_back(candidate.edge);
    if (components == 1) break;
  }
  std::sort(links.begin() + short_links, links.end());
  std::inplace_merge(links.begin(), links.begin() + short_links, links.end());
}

bool LinkSelection::still_holds(std::span<const double> x, std::span<const double> y, double limit,
                                std::span<const std::array<Index, 2>> edges) const {
  if (!short_ones_suffice_ || edges.size() != is_short_.size()) return false;
  bool same = true;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    same = same && (squared_length(x, y, edges[e]) <= limit * limit) == (is_short_[e] != 0);
  }
  return same;
}

}  // namespace metamorph::core
