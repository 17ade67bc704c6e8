#include "metamorph/body.h"

#include <algorithm>
#include <cmath>

#include "core/body/edge_uses.h"

namespace metamorph::core {

std::vector<std::array<Index, 2>> edges_of(const std::vector<std::array<Index, 3>>& triangles) {
  const std::vector<EdgeUse> uses = sorted_edge_uses(triangles);
  std::vector<std::array<Index, 2>> edges;
  edges.reserve(uses.size() / 2 + 1);
  for (std::size_t u = 0; u < uses.size(); u = end_of_edge(uses, u)) {
    edges.push_back({uses[u].low, uses[u].high});
  }
  return edges;
}

std::vector<std::array<Index, 2>> outline_of(const std::vector<std::array<Index, 3>>& triangles) {
  const std::vector<EdgeUse> uses = sorted_edge_uses(triangles);
  std::vector<std::array<Index, 2>> outline;
  for (std::size_t u = 0, next = 0; u < uses.size(); u = next) {
    next = end_of_edge(uses, u);
    if (next - u > 1) continue;
    // A counter-clockwise triangle lies on the left of its sides.
    const auto& triangle = triangles[static_cast<std::size_t>(uses[u].triangle)];
    outline.push_back({triangle[static_cast<std::size_t>(uses[u].side)],
                       triangle[static_cast<std::size_t>((uses[u].side + 1) % 3)]});
  }
  std::sort(outline.begin(), outline.end());
  return outline;
}

double signed_area(const Body& body, const std::array<Index, 3>& triangle) {
  const auto a = static_cast<std::size_t>(triangle[0]);
  const auto b = static_cast<std::size_t>(triangle[1]);
  const auto c = static_cast<std::size_t>(triangle[2]);
  return 0.5 * ((body.x[b] - body.x[a]) * (body.y[c] - body.y[a]) -
                (body.x[c] - body.x[a]) * (body.y[b] - body.y[a]));
}

double length(const Body& body, const std::array<Index, 2>& spring) {
  const auto a = static_cast<std::size_t>(spring[0]);
  const auto b = static_cast<std::size_t>(spring[1]);
  const double dx = body.x[b] - body.x[a];
  const double dy = body.y[b] - body.y[a];
  return std::sqrt(dx * dx + dy * dy);
}

void set_rest_from_nodes(Body& body) {
  body.springs = edges_of(body.triangles);
  body.rest_length.clear();
  body.rest_length.reserve(body.springs.size());
  for (const auto& spring : body.springs) body.rest_length.push_back(length(body, spring));
  body.rest_area.clear();
  body.rest_area.reserve(body.triangles.size());
  for (const auto& triangle : body.triangles) {
    body.rest_area.push_back(signed_area(body, triangle));
  }
}

}  // namespace metamorph::core
