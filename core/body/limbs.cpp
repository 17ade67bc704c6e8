#include "core/body/limbs.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace metamorph::core {
namespace {

constexpr double least_prominence = 0.4;  ///< radii of a disc of the same area

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

struct Direction {
  double x, y;
};

double cross(Direction a, Direction b) { return a.x * b.y - a.y * b.x; }
double dot(Direction a, Direction b) { return a.x * b.x + a.y * b.y; }

/// Whether turning counter-clockwise from `from` meets a before b.
bool is_met_before(Direction from, Direction a, Direction b) {
  const auto beyond_half = [&](Direction d) {
    const double side = cross(from, d);
    return side < 0 || (side == 0 && dot(from, d) > 0);  // `from` itself comes last
  };
  if (beyond_half(a) != beyond_half(b)) return beyond_half(b);
  return cross(a, b) > 0;
}

/// Distance of `centre` from where the segment is nearest to it.
double nearest(Direction a, Direction b, Direction centre) {
  const Direction along{b.x - a.x, b.y - a.y}, to{centre.x - a.x, centre.y - a.y};
  const double length2 = dot(along, along);
  const double share = length2 > 0 ? std::clamp(dot(along, to) / length2, 0.0, 1.0) : 0.0;
  const Direction gap{to.x - share * along.x, to.y - share * along.y};
  return std::sqrt(dot(gap, gap));
}

/// Maxima of a closed sequence of heights with a prominence of at least `rise`.
int count_peaks(const std::vector<double>& heights, double rise) {
  const auto lowest = std::min_element(heights.begin(), heights.end());
  int peaks = 0;
  bool climbing = true;  // looks for a peak; else for the next valley
  double extreme = *lowest;
  for (std::size_t i = 1; i <= heights.size(); ++i) {
    const auto from_lowest = static_cast<std::size_t>(lowest - heights.begin()) + i;
    const double height = heights[from_lowest % heights.size()];
    if (climbing ? height > extreme : height < extreme) {
      extreme = height;
    } else if (climbing && height <= extreme - rise) {
      ++peaks;
      climbing = false;
      extreme = height;
    } else if (!climbing && height >= extreme + rise) {
      climbing = true;
      extreme = height;
    }
  }
  return peaks;
}

}  // namespace

std::vector<Index> around_outside(const Body& body, std::span<const std::array<Index, 2>> outline) {
  const auto place = [&](Index node) { return Direction{body.x[at(node)], body.y[at(node)]}; };
  // The body lies on the left of outline edges, the outside on their right. So at every node the
  // way goes on along the first edge that is met on turning counter-clockwise, through the outside,
  // from where it came.
  const auto next = [&](Index node, Direction from) {
    const auto begin = std::lower_bound(outline.begin(), outline.end(), std::array{node, Index{0}});
    Index best = (*begin)[1];
    const auto towards = [&](Index other) {
      return Direction{place(other).x - place(node).x, place(other).y - place(node).y};
    };
    for (auto edge = begin + 1; edge != outline.end() && (*edge)[0] == node; ++edge) {
      if (is_met_before(from, towards((*edge)[1]), towards(best))) best = (*edge)[1];
    }
    return best;
  };

  Index start = outline[0][0];
  for (const auto& edge : outline) {
    const Direction a = place(edge[0]), b = place(start);
    if (a.x < b.x || (a.x == b.x && a.y < b.y)) start = edge[0];
  }
  std::vector<Index> nodes = {start};
  const Index second = next(start, {-1, 0});
  Index before = start, node = second;
  // No longer than the outline, even if it is none of a sound body.
  while (nodes.size() < outline.size()) {
    const Direction back{place(before).x - place(node).x, place(before).y - place(node).y};
    const Index after = next(node, back);
    if (node == start && after == second) break;
    nodes.push_back(node);
    before = node;
    node = after;
  }
  return nodes;
}

int count_limbs(const Body& body, const Area& area, std::span<const std::array<Index, 2>> outline) {
  const std::vector<Index> nodes = around_outside(body, outline);
  const Direction centre{area.centroid[0], area.centroid[1]};
  std::vector<double> distance;
  distance.reserve(2 * nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const std::size_t a = at(nodes[i]), b = at(nodes[(i + 1) % nodes.size()]);
    const Direction from{body.x[a], body.y[a]}, to{body.x[b], body.y[b]};
    distance.push_back(nearest(from, from, centre));
    distance.push_back(nearest(from, to, centre));
  }
  return count_peaks(distance, least_prominence * std::sqrt(area.size / std::numbers::pi));
}

}  // namespace metamorph::core
