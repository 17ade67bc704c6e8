#include "core/locomotion/solid_pairs.h"

#include <algorithm>

#include "core/locomotion/segment_distance.h"

namespace metamorph::core {
namespace {

double gap(const Body& body, Index node, const std::array<Index, 2>& edge) {
  return distance_from_edge(body.x, body.y, node, edge);
}

std::vector<Index> outline_nodes(const std::vector<std::array<Index, 2>>& outline) {
  std::vector<Index> nodes;
  for (const auto& edge : outline) nodes.push_back(edge[0]);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

}  // namespace

std::vector<SolidPair> solid_pairs(const Body& body, const Scene& scene) {
  const std::vector<std::array<Index, 2>> outline = outline_of(body.triangles);
  const std::vector<Index> nodes = outline_nodes(outline);
  std::vector<SolidPair> pairs;
  for (const auto& edge : outline) {
    for (const Index node : nodes) {
      if (node == edge[0] || node == edge[1]) continue;
      pairs.push_back({node, edge, std::min(scene.collision_gap, gap(body, node, edge))});
    }
  }
  const std::vector<SolidPair> corners = corners_without_pressure(body, scene);
  pairs.insert(pairs.end(), corners.begin(), corners.end());
  return pairs;
}

std::vector<SolidPair> corners_without_pressure(const Body& body, const Scene& scene) {
  std::vector<SolidPair> pairs;
  if (std::none_of(body.rest_area.begin(), body.rest_area.end(),
                   [&](double area) { return area < scene.min_pressure_area; })) {
    return pairs;
  }
  const std::vector<std::array<Index, 2>> outline = outline_of(body.triangles);
  const std::vector<Index> nodes = outline_nodes(outline);
  for (std::size_t t = 0; t < body.triangles.size(); ++t) {
    if (body.rest_area[t] >= scene.min_pressure_area) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      const Index node = body.triangles[t][c];
      const std::array<Index, 2> side = {body.triangles[t][(c + 1) % 3],
                                         body.triangles[t][(c + 2) % 3]};
      if (std::binary_search(nodes.begin(), nodes.end(), node) &&
          std::binary_search(outline.begin(), outline.end(), side)) {
        continue;
      }
      pairs.push_back({node, side, std::min(scene.collision_gap, gap(body, node, side))});
    }
  }
  return pairs;
}

}  // namespace metamorph::core
