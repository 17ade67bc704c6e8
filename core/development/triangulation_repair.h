#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/body/predicates.h"
#include "core/development/delaunay.h"
#include "core/development/ghost_mesh.h"

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
  TriangulationRepair();

  /// Brings the triangulation to these positions (finite). previous[i]: the index that point i had
  /// in the last update, or -1 if it is new; ascending, new ones last.
  void update(std::span<const double> x, std::span<const double> y,
              std::span<const Index> previous);

  /// Forgets the last update: the next one builds anew.
  void clear() { mesh_.clear(); }

  std::vector<std::array<Index, 2>> edges();        ///< see Triangulation
  std::vector<std::array<Index, 3>> faces() const;  ///< see Triangulation
  /// Whether the last update may have changed an edge.
  bool changed() const { return changed_; }
  /// How often update() built anew so far.
  long rebuilds() const { return rebuilds_; }

  /// Whether the last update left every edge of the mesh between the points it was between, but for
  /// the replaced() ones. If not, points were renumbered or the mesh built anew, or there is none.
  bool patched() const { return patched_; }
  /// Empty where points coincide or all lie on a straight line.
  const GhostMesh& mesh() const { return mesh_; }
  /// Squared length of each edge of the mesh; for replaced ones, perhaps that of another.
  const double* squares() const { return square_.data(); }
  double squared_length(Index a, Index b) const {
    const double dx = point(a).x - point(b).x, dy = point(a).y - point(b).y;
    return dx * dx + dy * dy;
  }

 private:
  using Side = GhostMesh::Side;
  /// Points with a few in front of them, at the indices from -3 on, that stand for the ghost.
  struct alignas(16) Record {
    double x, y;
  };
  static constexpr int stand_ins = 3;

  bool repair(std::span<const Index> previous);
  bool prepare(std::span<const Index> previous);
  bool remove_dead(std::span<const Index> previous);
  bool remove_folding();
  GhostMesh::Side folding_side(int edge) const;
  bool remove(Index vertex, int start);
  int shorten_ring(Index vertex, int start);
  bool insert(Index vertex);
  int face_around(Point target) const;
  void refresh_edge(int edge);
  void refresh_touched();
  void refresh_all();
  void find_suspects();
  bool settle();
  bool settle_doubtful();
  bool is_illegal(Side side) const;
  bool hull_winds_once();
  int face_near(Point target) const;
  Triangulation anew() const;
  void rebuild(std::span<const double> x, std::span<const double> y);
  bool flip(Side side) {
    changed_ = true;
    return mesh_.flip(side);
  }

  Point point(Index vertex) const { return in(points_, vertex); }
  Point target(Index vertex) const { return in(target_, vertex); }
  static Point in(const std::vector<Record>& records, Index vertex) {
    const Record& record = records[static_cast<std::size_t>(vertex + stand_ins)];
    return {record.x, record.y};
  }
  int orientation_of(Index a, Index b, Index c) const {
    return orientation(point(a), point(b), point(c));
  }

  std::vector<Record> points_;   // where the mesh is
  std::vector<Record> target_;   // where it goes
  std::vector<Index> inserted_;  // points that are out of the mesh
  GhostMesh mesh_;
  std::vector<Side> doubtful_;                        // edges that may be illegal
  std::array<std::vector<std::int32_t>, 4> corners_;  // [edges] see kernels::QuadrilateralView
  std::size_t refreshed_ = 0;                         // of mesh_.touched(), in corners_
  std::vector<double> square_;
  std::vector<std::int32_t> suspects_;
  std::vector<Index> name_;
  int hull_face_ = 0;  // was a face of the ghost's
  bool changed_ = true;
  bool patched_ = false;
  long rebuilds_ = 0;
};

}  // namespace metamorph::core
