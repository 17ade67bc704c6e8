#include "core/locomotion/crossed_edge.h"

#include <algorithm>
#include <limits>

#include "core/body/outline_crossing.h"
#include "core/locomotion/segment_distance.h"

namespace metamorph::core {

std::optional<CrossedEdge> crossed_edge(const Body& body, std::span<const double> x,
                                        std::span<const double> y) {
  const auto outline = outline_of(body.triangles);
  const std::optional<OutlineCrossing> crossing = first_crossing(x, y, outline);
  if (!crossing) return std::nullopt;
  CrossedEdge found;
  double nearest = std::numeric_limits<double>::infinity();
  for (const bool second : {false, true}) {
    const auto& edge = outline[static_cast<std::size_t>(crossing->edges[second ? 1 : 0])];
    const auto& other = outline[static_cast<std::size_t>(crossing->edges[second ? 0 : 1])];
    for (const Index node : other) {
      if (node == edge[0] || node == edge[1]) continue;
      const double distance = distance_from_edge(x, y, node, edge);
      if (distance >= nearest) continue;
      nearest = distance;
      const auto [low, high] = std::minmax(edge[0], edge[1]);
      const std::array<Index, 2> spring = {low, high};
      found.node = node;
      found.spring =
          static_cast<Index>(std::lower_bound(body.springs.begin(), body.springs.end(), spring) -
                             body.springs.begin());
    }
  }
  return found;
}

}  // namespace metamorph::core
