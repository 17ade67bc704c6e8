#include "core/body/edge_uses.h"

#include <algorithm>

namespace metamorph::core {
namespace {

/// One stable counting-sort pass by the given key.
template <class Key>
void counting_sort(const std::vector<EdgeUse>& in, std::vector<EdgeUse>& out, Index keys, Key key) {
  std::vector<std::size_t> next(static_cast<std::size_t>(keys) + 1, 0);
  for (const EdgeUse& use : in) ++next[static_cast<std::size_t>(key(use)) + 1];
  for (std::size_t k = 1; k < next.size(); ++k) next[k] += next[k - 1];
  for (const EdgeUse& use : in) out[next[static_cast<std::size_t>(key(use))]++] = use;
}

}  // namespace

std::vector<EdgeUse> sorted_edge_uses(const std::vector<std::array<Index, 3>>& triangles) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * triangles.size());
  Index nodes = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (int side = 0; side < 3; ++side) {
      const Index a = triangles[t][static_cast<std::size_t>(side)];
      const Index b = triangles[t][static_cast<std::size_t>((side + 1) % 3)];
      uses.push_back({std::min(a, b), std::max(a, b), static_cast<Index>(t), side});
      nodes = std::max(nodes, a + 1);
    }
  }
  std::vector<EdgeUse> scratch(uses.size());
  counting_sort(uses, scratch, nodes, [](const EdgeUse& use) { return use.high; });
  counting_sort(scratch, uses, nodes, [](const EdgeUse& use) { return use.low; });
  return uses;
}

}  // namespace metamorph::core
