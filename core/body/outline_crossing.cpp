#include "core/body/outline_crossing.h"

#include <algorithm>
#include <tuple>
#include <vector>

#include "core/body/parts.h"
#include "core/body/predicates.h"

namespace metamorph::core {
namespace {

using Edge = std::array<Index, 2>;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

struct Positions {
  std::span<const double> x, y;
  Point operator[](Index node) const { return {x[at(node)], y[at(node)]}; }
};

/// By x, then y.
bool before(Point a, Point b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

int turn(const Positions& p, Index a, Index b, Index c) { return orientation(p[a], p[b], p[c]); }

bool within_box(Point p, Point a, Point b) {
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

/// Of edges with a common node: the end of one that lies on the other.
std::optional<Index> folded_node(const Positions& p, Index common, Index a, Index b) {
  if (a == b) return a;
  if (turn(p, common, a, b) != 0) return std::nullopt;
  if (within_box(p[a], p[common], p[b])) return a;
  if (within_box(p[b], p[common], p[a])) return b;
  return std::nullopt;
}

/// How two edges meet whose bounding boxes do.
std::optional<OutlineCrossing> meeting_of(const Positions& p, Edge e, Edge f) {
  for (const std::size_t i : {0u, 1u}) {
    for (const std::size_t j : {0u, 1u}) {
      if (e[i] != f[j]) continue;
      const auto node = folded_node(p, e[i], e[1 - i], f[1 - j]);
      if (!node) return std::nullopt;
      return OutlineCrossing{{}, Meeting::touching, *node};
    }
  }
  const int e0 = turn(p, f[0], f[1], e[0]), e1 = turn(p, f[0], f[1], e[1]);
  if (e0 * e1 > 0) return std::nullopt;
  const int f0 = turn(p, e[0], e[1], f[0]), f1 = turn(p, e[0], e[1], f[1]);
  if (f0 * f1 > 0) return std::nullopt;
  // On one straight line they meet, for their boxes do.
  for (const auto& [side, node, edge] : {std::tuple(e0, e[0], f), std::tuple(e1, e[1], f),
                                         std::tuple(f0, f[0], e), std::tuple(f1, f[1], e)}) {
    if (side == 0 && within_box(p[node], p[edge[0]], p[edge[1]])) {
      return OutlineCrossing{{}, Meeting::touching, node};
    }
  }
  return OutlineCrossing{};
}

/// The lowest pair of edges that meet: edges are taken up from left to right, each is compared with
/// those that reach so far.
std::optional<OutlineCrossing> first_meeting(const Positions& p, std::span<const Edge> outline) {
  struct Box {
    double left, right, low, high;
    Index edge;
  };
  std::vector<Box> boxes;
  boxes.reserve(outline.size());
  for (std::size_t e = 0; e < outline.size(); ++e) {
    const Point a = p[outline[e][0]], b = p[outline[e][1]];
    boxes.push_back({std::min(a.x, b.x), std::max(a.x, b.x), std::min(a.y, b.y), std::max(a.y, b.y),
                     static_cast<Index>(e)});
  }
  std::sort(boxes.begin(), boxes.end(), [](const Box& a, const Box& b) { return a.left < b.left; });
  std::vector<Box> open;
  std::optional<OutlineCrossing> first;
  for (const Box& box : boxes) {
    std::size_t kept = 0;
    for (const Box& other : open) {
      if (other.right < box.left) continue;
      open[kept++] = other;
      if (other.high < box.low || box.high < other.low) continue;
      const auto [low, high] = std::minmax(box.edge, other.edge);
      const Edge edges = {low, high};
      if (first && first->edges < edges) continue;
      if (const auto found = meeting_of(p, outline[at(low)], outline[at(high)])) {
        first = found;
        first->edges = edges;
      }
    }
    open.resize(kept);
    open.push_back(box);
  }
  return first;
}

/// An edge as a node sees it.
struct Ray {
  Point to;
  bool out;  ///< begins at the node
  Index edge;
};

std::vector<Ray> rays_from(const Positions& p, std::span<const Edge> outline, Index node) {
  std::vector<Ray> rays;
  for (std::size_t e = 0; e < outline.size(); ++e) {
    const auto [a, b] = outline[e];
    if (a == node) rays.push_back({p[b], true, static_cast<Index>(e)});
    if (b == node) rays.push_back({p[a], false, static_cast<Index>(e)});
  }
  // Counter-clockwise, from straight down (excluded) on.
  std::sort(rays.begin(), rays.end(), [centre = p[node]](const Ray& a, const Ray& b) {
    const bool a_right = before(centre, a.to), b_right = before(centre, b.to);
    return a_right != b_right ? a_right : orientation(centre, a.to, b.to) > 0;
  });
  return rays;
}

/// Around a node the body lies from an edge that begins there to one that ends there,
/// counter-clockwise; where parts do not overlap, beginnings and ends alternate.
std::optional<OutlineCrossing> first_pinch(const Positions& p, std::span<const Edge> outline) {
  std::vector<int> begins(p.x.size(), 0);
  for (const Edge& edge : outline) ++begins[at(edge[0])];
  for (std::size_t n = 0; n < begins.size(); ++n) {
    if (begins[n] < 2) continue;
    const auto node = static_cast<Index>(n);
    const std::vector<Ray> rays = rays_from(p, outline, node);
    for (std::size_t r = 0; r < rays.size(); ++r) {
      const Ray& next = rays[(r + 1) % rays.size()];
      if (rays[r].out != next.out) continue;
      const auto [low, high] = std::minmax(rays[r].edge, next.edge);
      return OutlineCrossing{{low, high}, Meeting::pinch, node};
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<OutlineCrossing> first_crossing(std::span<const double> x, std::span<const double> y,
                                              std::span<const Edge> outline) {
  const Positions p{x, y};
  const auto meeting = first_meeting(p, outline);
  return meeting ? meeting : first_pinch(p, outline);
}

// Along edges that hang together the winding number on the right stays the same. Of what lies left
// of their leftmost node they enclose nothing: the winding number there is that of all other edges.
std::optional<Index> first_overlap(std::span<const double> x, std::span<const double> y,
                                   std::span<const Edge> outline) {
  const Positions p{x, y};
  Parts parts(x.size());
  for (const Edge& edge : outline) parts.join(at(edge[0]), at(edge[1]));
  std::vector<Index> leftmost(x.size(), -1);  // by the first node of a part
  for (const Edge& edge : outline) {
    Index& node = leftmost[parts.first(at(edge[0]))];
    if (node < 0 || before(p[edge[0]], p[node])) node = edge[0];
  }
  for (std::size_t part = 0; part < leftmost.size(); ++part) {
    const Index node = leftmost[part];
    if (node < 0) continue;
    int winding = 0;  // edges below the node that run to the right, less those to the left
    for (const auto& [a, b] : outline) {
      const bool a_left = p[a].x <= p[node].x, b_left = p[b].x <= p[node].x;
      if (a_left == b_left || parts.first(at(a)) == part) continue;
      if (turn(p, a, b, node) == (a_left ? 1 : -1)) winding += a_left ? 1 : -1;
    }
    // All edges lead to the right; on the right of the lowest lies what lies left of the node.
    const Ray lowest = rays_from(p, outline, node).front();
    if (winding != (lowest.out ? 0 : 1)) return lowest.edge;
  }
  return std::nullopt;
}

}  // namespace metamorph::core
