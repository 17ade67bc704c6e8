#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/ghost_mesh.h"
#include "core/predicates.h"

namespace metamorph::core {

/// A Delaunay triangulation that follows its points: renewed from the one before instead of from
/// nothing, and always with the edges and faces that triangulate() gives.
///
/// An update (1) takes out the points that are gone and those whose motion would turn a face inside
/// out, (2) moves the others, (3) flips edges until each is locally Delaunay and the hull convex
/// (Lawson 1977), (4) puts each new point, and each of those that moved too far, into the face it
/// lies in and flips around it. That all faces are
/// counter-clockwise and that the hull is convex and winds once makes the result a triangulation;
/// that every edge is locally Delaunay makes it the Delaunay triangulation. Both are checked, by
/// exact predicates. Whatever cannot be repaired this way is built anew by triangulate().
class TriangulationRepair {
 public:
  /// Brings the triangulation to these positions (finite). previous[i]: the index that point i had
  /// in the last update, or -1 if it is new; ascending, new ones last.
  void update(std::span<const double> x, std::span<const double> y,
              std::span<const Index> previous);

  /// Forgets the last update: the next one builds anew.
  void clear() { mesh_.clear(); }

  const std::vector<std::array<Index, 2>>& edges() const { return edges_; }  ///< see Triangulation
  std::vector<std::array<Index, 3>> faces() const;                           ///< see Triangulation
  /// Whether the last update may have changed an edge.
  bool changed() const { return changed_; }
  /// How often update() built anew so far.
  long rebuilds() const { return rebuilds_; }

 private:
  using Side = GhostMesh::Side;

  bool repair(std::span<const Index> previous);
  bool remove_dead(std::span<const Index> previous);
  bool remove_folding();
  bool remove(Index vertex);
  bool shorten_ring(Index vertex, int start);
  bool insert(Index vertex);
  int face_around(Point target) const;
  bool settle_all();
  void collect_inner_edges();
  bool settle_doubtful();
  bool is_illegal(Side side) const;
  bool hull_winds_once() const;
  void rebuild(std::span<const double> x, std::span<const double> y);
  bool flip(Side side) {
    changed_ = true;
    return mesh_.flip(side);
  }

  Point point(Index vertex) const { return points_[static_cast<std::size_t>(vertex)]; }
  int orientation_of(Index a, Index b, Index c) const {
    return orientation(point(a), point(b), point(c));
  }

  std::vector<Point> points_;    // where the mesh is
  std::vector<Point> target_;    // where it goes
  std::vector<Index> inserted_;  // points that are out of the mesh
  GhostMesh mesh_;               // empty where points coincide or all lie on a straight line
  std::vector<Side> doubtful_;   // edges that may be illegal
  std::vector<Side> sides_;      // scratch of settle_all
  std::array<std::vector<Index>, 4> corners_;
  std::vector<Index> suspects_;
  std::vector<Index> name_;
  std::vector<std::array<Index, 2>> edges_;
  bool changed_ = true;
  long rebuilds_ = 0;
};

}  // namespace metamorph::core
