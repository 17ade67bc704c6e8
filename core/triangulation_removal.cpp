#include <cstddef>

#include "core/triangulation_repair.h"

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
  name_.assign(points_.size(), -1);
  Index survivors = 0;
  for (const Index old : previous) {
    if (old >= 0) name_[static_cast<std::size_t>(old)] = survivors++;
  }
  if (static_cast<std::size_t>(survivors) == points_.size()) return true;
  if (survivors < 3) return false;
  changed_ = true;
  for (std::size_t v = 0; v < name_.size(); ++v) {
    if (name_[v] < 0 && !remove(static_cast<Index>(v))) return false;
  }
  mesh_.rename(name_);
  for (std::size_t v = 0; v < name_.size(); ++v) {
    if (name_[v] >= 0) points_[static_cast<std::size_t>(name_[v])] = points_[v];
  }
  return true;
}

/// Takes out points until the motion of the others turns no face inside out.
bool TriangulationRepair::remove_folding() {
  constexpr int most = 16;  // beyond, building anew is as fast
  const auto target = [this](Index v) { return target_[static_cast<std::size_t>(v)]; };
  for (int f = 0; f < mesh_.face_count();) {
    const auto [a, b, c] = mesh_.face(f).vertex;
    if (a == ghost || b == ghost || c == ghost ||
        orientation(target(a), target(b), target(c)) > 0) {
      ++f;
      continue;
    }
    const int corner = widest_corner(target(a), target(b), target(c));
    inserted_.push_back(mesh_.vertex(f, corner));
    if (inserted_.size() > most || inserted_.size() + 3 > target_.size()) return false;
    if (!remove(inserted_.back())) return false;
    f = 0;
  }
  return true;
}

/// Flips edges away from a vertex until it has three neighbours, then drops it.
bool TriangulationRepair::remove(Index vertex) {
  for (;;) {
    int start = 0;
    while (mesh_.corner_of(start, vertex) < 0) ++start;
    int degree = 0;
    int f = start;
    do {
      f = mesh_.across(f, GhostMesh::next(mesh_.corner_of(f, vertex)));
      ++degree;
    } while (f != start);
    if (degree == 3) {
      mesh_.dissolve({start, mesh_.corner_of(start, vertex)});
      return true;
    }
    if (!shorten_ring(vertex, start)) return false;
  }
}

/// Flips one edge between a vertex and its ring: where an ear can be cut off the ring, or else, on
/// the hull, where the vertex gives up its first face there.
bool TriangulationRepair::shorten_ring(Index vertex, int start) {
  Side hull_side;
  bool on_hull = false;
  int f = start;
  do {
    // f = (vertex, p, u), its successor around the vertex (vertex, u, q).
    const int corner = mesh_.corner_of(f, vertex);
    const Side edge = {f, GhostMesh::next(corner)};
    const auto [u, same, p, q] = mesh_.around(edge);
    if (u != ghost && p != ghost && q != ghost) {
      if (orientation_of(p, u, q) > 0 && orientation_of(p, q, vertex) > 0 && flip(edge))
        return true;
    } else if (u != ghost && p == ghost) {
      hull_side = edge;
      on_hull = true;
    }
    f = mesh_.across(f, GhostMesh::next(corner));
  } while (f != start);
  return on_hull && flip(hull_side);
}

}  // namespace metamorph::core
