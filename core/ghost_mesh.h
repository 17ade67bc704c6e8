#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/body.h"

namespace metamorph::core {

/// The connections of a triangulation of the plane, without coordinates. The outside is made of
/// ghost faces: every edge of the hull has one behind it, whose third corner is the ghost, so that
/// the whole is a sphere and a change of the hull is an edge flip like any other.
class GhostMesh {
 public:
  static constexpr Index ghost = -1;

  struct Face {
    std::array<Index, 3> vertex;  ///< counter-clockwise
    std::array<int, 3> across;    ///< the face on the other side of the edge opposite each vertex
  };
  /// An edge as one of its faces sees it: the one opposite vertex[corner].
  struct Side {
    int face;
    int corner;
  };
  /// The corners of a side's two faces: the edge is a-b, the faces are (c, a, b) and (d, b, a).
  struct Quadrilateral {
    Index a, b, c, d;
  };

  static constexpr int next(int corner) { return corner == 2 ? 0 : corner + 1; }
  static constexpr int before(int corner) { return corner == 0 ? 2 : corner - 1; }

  /// Replaces the mesh by that of a triangulation's faces (counter-clockwise). Leaves it empty and
  /// says false unless each of the vertices 0 .. count-1 is in a face.
  bool connect(std::span<const std::array<Index, 3>> triangles, Index count);
  void clear() { faces_.clear(); }
  bool empty() const { return faces_.empty(); }

  int face_count() const { return static_cast<int>(faces_.size()); }
  const Face& face(int f) const { return faces_[static_cast<std::size_t>(f)]; }
  Index vertex(int f, int corner) const { return face(f).vertex[static_cast<std::size_t>(corner)]; }
  int across(int f, int corner) const { return face(f).across[static_cast<std::size_t>(corner)]; }
  /// The corner at which the ghost sits, or -1 in a real face.
  int ghost_corner(int f) const { return corner_of(f, ghost); }
  /// The corner at which a vertex sits, or -1.
  int corner_of(int f, Index vertex) const;
  /// The corner of f opposite the edge shared with its neighbour g.
  int corner_towards(int f, int g) const;
  Quadrilateral around(Side side) const;

  /// Replaces the edge a-b of faces f (the side's) and g by c-d: f = (c, a, d), g = (c, d, b).
  /// False and nothing done if c and d are neighbours already.
  bool flip(Side side);
  /// Puts a new vertex into a face; it is corner 2 of the face and of the two last ones.
  void split(int f, Index vertex);
  /// Removes a vertex that has three neighbours. Renumbers faces.
  void dissolve(Side corner);
  /// Gives every vertex v the number name[v].
  void rename(std::span<const Index> name);

  /// All edges between real vertices, i < j, ascending. count: number of vertices.
  void list_edges(Index count, std::vector<std::array<Index, 2>>& edges);
  /// All real faces, lowest index first, ascending.
  void list_faces(std::vector<std::array<Index, 3>>& faces) const;

 private:
  Face& at(int f) { return faces_[static_cast<std::size_t>(f)]; }
  bool are_neighbours(Side corner, Index other) const;
  void redirect(int f, int from, int to);
  void erase_face(int f);

  std::vector<Face> faces_;
  std::vector<int> bucket_;  // scratch
};

}  // namespace metamorph::core
