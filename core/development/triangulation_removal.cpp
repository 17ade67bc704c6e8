#include <cstddef>

#include "core/development/triangulation_repair.h"

namespace metamorph::core {
namespace {

constexpr Index ghost = GhostMesh::ghost;

double squared_distance(Point a, Point b) {
  return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
}

/// The corner at the largest angle: in a face that has just turned over, the one that passed
/// through the edge opposite it.
int widest_corner(Point a, Point b, Point c) {
  const double bc = squared_distance(b, c), ca = squared_distance(c, a),
               ab = squared_distance(a, b);
  return bc >= ca && bc >= ab ? 0 : ca >= ab ? 1 : 2;
}

}  // namespace

/// Takes out the points that are no longer there and renames the others.
bool TriangulationRepair::remove_dead(std::span<const Index> previous) {
  const std::size_t before = points_.size() - stand_ins;
  // Ascending: if the last of them is in its place, so are all.
  if (previous.size() >= before && previous[before - 1] == static_cast<Index>(before) - 1) {
    return true;
  }
  name_.assign(before, -1);
  Index survivors = 0;
  for (const Index old : previous) {
    if (old >= 0) name_[static_cast<std::size_t>(old)] = survivors++;
  }
  if (survivors < 3) return false;
  changed_ = true;
  for (std::size_t v = 0; v < name_.size(); ++v) {
    if (name_[v] >= 0) continue;
    int start = 0;
    while (mesh_.corner_of(start, static_cast<Index>(v)) < 0) ++start;
    if (!remove(static_cast<Index>(v), start)) return false;
  }
  mesh_.rename(name_);
  refresh_all();
  patched_ = false;
  for (std::size_t v = 0; v < name_.size(); ++v) {
    if (name_[v] >= 0) {
      points_[stand_ins + static_cast<std::size_t>(name_[v])] = points_[stand_ins + v];
    }
  }
  return true;
}

/// Takes out points until the motion of the others turns no face inside out. Every such face has a
/// suspect edge at first, and a touched one later.
bool TriangulationRepair::remove_folding() {
  constexpr int most = 16;  // beyond, building anew is as fast
  std::size_t touched = mesh_.touched().size();
  while (!suspects_.empty()) {
    const int edge = suspects_.back();
    const Side folded = edge < mesh_.edge_count() ? folding_side(edge) : Side{0, 3};
    if (folded.corner() == 3) {
      suspects_.pop_back();
      continue;
    }
    const auto [a, b, c] = mesh_.face(folded.face()).vertex;
    const int corner = widest_corner(target(a), target(b), target(c));
    inserted_.push_back(mesh_.vertex(folded.face(), corner));
    if (inserted_.size() > most || inserted_.size() + 3 + stand_ins > target_.size()) return false;
    if (!remove(inserted_.back(), folded.face())) return false;
    for (; touched < mesh_.touched().size(); ++touched) {
      suspects_.push_back(mesh_.touched()[touched]);
    }
  }
  return true;
}

/// The side of an edge whose face the motion to the targets turns inside out; corner 3 if there is
/// none.
GhostMesh::Side TriangulationRepair::folding_side(int edge) const {
  for (const Side side : {mesh_.side_of(edge), mesh_.twin(mesh_.side_of(edge))}) {
    const auto [a, b, c] = mesh_.face(side.face()).vertex;
    if (a == ghost || b == ghost || c == ghost) continue;
    if (orientation(target(a), target(b), target(c)) <= 0) return side;
  }
  return {0, 3};
}

/// Flips edges away from a vertex until it has three neighbours, then drops it. start: one of its
/// faces.
bool TriangulationRepair::remove(Index vertex, int start) {
  for (;;) {
    int degree = 0;
    int f = start;
    do {
      f = mesh_.across(f, GhostMesh::next(mesh_.corner_of(f, vertex)));
      ++degree;
    } while (f != start);
    if (degree == 3) {
      mesh_.dissolve({start, mesh_.corner_of(start, vertex)});
      changed_ = true;
      return true;
    }
    start = shorten_ring(vertex, start);
    if (start < 0) return false;
  }
}

/// Flips one edge between a vertex and its ring: where an ear can be cut off the ring, or else, on
/// the hull, where the vertex gives up its first face there. A face that is left to the vertex, or
/// -1 if no edge can be flipped.
int TriangulationRepair::shorten_ring(Index vertex, int start) {
  Side hull_side;
  bool on_hull = false;
  int f = start;
  // A flip leaves the face behind the edge to the vertex.
  const auto flipped = [this](Side edge) {
    const int behind = mesh_.twin(edge).face();
    return flip(edge) ? behind : -1;
  };
  do {
    // f = (vertex, p, u), its successor around the vertex (vertex, u, q).
    const int corner = mesh_.corner_of(f, vertex);
    const Side edge = {f, GhostMesh::next(corner)};
    const auto [u, same, p, q] = mesh_.around(edge);
    if (u != ghost && p != ghost && q != ghost) {
      if (orientation_of(p, u, q) > 0 && orientation_of(p, q, vertex) > 0) {
        if (const int left = flipped(edge); left >= 0) return left;
      }
    } else if (u != ghost && p == ghost) {
      hull_side = edge;
      on_hull = true;
    }
    f = mesh_.across(f, GhostMesh::next(corner));
  } while (f != start);
  return on_hull ? flipped(hull_side) : -1;
}

}  // namespace metamorph::core
