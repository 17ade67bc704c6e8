#include "core/development/links.h"

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

bool LinkSelection::select(std::span<const double> x, std::span<const double> y, double limit,
                           std::span<const std::array<Index, 2>> edges,
                           std::vector<std::array<Index, 2>>& links) {
  // Written so that nothing branches on a length. If every cell but one has a short link to a lower
  // one, the short links connect all.
  has_lower_.assign(x.size(), 0);
  is_short_.resize(edges.size());
  links.resize(edges.size());
  std::size_t count = 0, lowest = x.size();
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto j = static_cast<std::size_t>(edges[e][1]);
    const unsigned char is_short = squared_length(x, y, edges[e]) <= limit * limit;
    is_short_[e] = is_short;
    links[count] = edges[e];
    count += is_short;
    lowest -= static_cast<std::size_t>(is_short & ~has_lower_[j] & 1);
    has_lower_[j] |= is_short;
  }
  links.resize(count);
  return lowest <= 1 || join_components(x, y, edges, links);
}

/// Adds the long edges that join components of the short ones; true if there was nothing to add.
bool LinkSelection::join_components(std::span<const double> x, std::span<const double> y,
                                    std::span<const std::array<Index, 2>> edges,
                                    std::vector<std::array<Index, 2>>& links) {
  parent_.resize(x.size());
  std::iota(parent_.begin(), parent_.end(), 0);
  std::size_t components = x.size();
  const auto join = [&](const std::array<Index, 2>& edge) {
    const Index a = root(edge[0]), b = root(edge[1]);
    if (a == b) return false;
    parent_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    --components;
    return true;
  };
  for (const auto& link : links) join(link);
  if (components <= 1) return true;

  long_edges_.clear();
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (!is_short_[e]) long_edges_.push_back({squared_length(x, y, edges[e]), edges[e]});
  }
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
  return false;
}

}  // namespace metamorph::core
