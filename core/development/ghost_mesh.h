#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "metamorph/body.h"

namespace metamorph::core {

/// The connections of a triangulation of the plane, without coordinates. The outside is made of
/// ghost faces: every edge of the hull has one behind it, whose third corner is the ghost, so that
/// the whole is a sphere and a change of the hull is an edge flip like any other.
class GhostMesh {
 public:
  static constexpr Index ghost = -1;

  /// An edge as one of its faces sees it: the one opposite vertex[corner]. Four bytes.
  struct Side {
    std::uint32_t code;  // 4 * face + corner

    Side() = default;
    Side(int face, int corner) : code(static_cast<std::uint32_t>(4 * face + corner)) {}
    int face() const { return static_cast<int>(code >> 2); }
    int corner() const { return static_cast<int>(code & 3); }
  };
  struct Face {
    std::array<Index, 3> vertex;  ///< counter-clockwise
    std::array<Side, 3> twin;     ///< the edge opposite each vertex as the face behind it sees it
    std::array<int, 3> edge;      ///< number of the edge opposite each vertex
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
  void clear();
  bool empty() const { return faces_.empty(); }

  int face_count() const { return static_cast<int>(faces_.size()); }
  const Face& face(int f) const { return faces_[static_cast<std::size_t>(f)]; }
  Index vertex(int f, int corner) const { return face(f).vertex[static_cast<std::size_t>(corner)]; }
  Side twin(Side side) const {
    return face(side.face()).twin[static_cast<std::size_t>(side.corner())];
  }
  /// The face behind the edge opposite a corner.
  int across(int f, int corner) const { return twin({f, corner}).face(); }
  /// The corner at which a vertex sits, or -1.
  int corner_of(int f, Index vertex) const {
    const auto& v = face(f).vertex;
    return v[0] == vertex ? 0 : v[1] == vertex ? 1 : v[2] == vertex ? 2 : -1;
  }
  /// The corner at which the ghost sits, or -1 in a real face.
  int ghost_corner(int f) const { return corner_of(f, ghost); }
  int edge_count() const { return static_cast<int>(side_of_edge_.size()); }
  int edge(Side side) const {
    return face(side.face()).edge[static_cast<std::size_t>(side.corner())];
  }
  /// One of the two sides of an edge.
  Side side_of(int edge) const { return side_of_edge_[static_cast<std::size_t>(edge)]; }
  /// Numbers of the edges that got other ends or other faces since forget_changes(), in any order
  /// and perhaps repeatedly, some of them perhaps no longer in use. After connect(), clear() and
  /// rename() they do not tell all.
  std::span<const int> touched() const { return touched_; }
  /// The same of those that may have got other ends.
  std::span<const int> replaced() const { return replaced_; }
  void forget_changes() {
    touched_.clear();
    replaced_.clear();
  }

  Quadrilateral around(Side side) const {
    const int f = side.face(), i = side.corner();
    const Side behind = twin(side);
    return {vertex(f, next(i)), vertex(f, before(i)), vertex(f, i),
            vertex(behind.face(), behind.corner())};
  }

  /// Replaces the edge a-b of faces f (the side's) and g by c-d: f = (c, a, d), g = (c, d, b).
  /// False and nothing done if c and d are neighbours already.
  bool flip(Side side);
  /// Puts a new vertex into a face; it is corner 2 of the face and of the two last ones.
  void split(int f, Index vertex);
  /// Removes a vertex that has three neighbours. Renumbers faces and edges.
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
  void join(Side a, Side b) {
    at(a.face()).twin[static_cast<std::size_t>(a.corner())] = b;
    at(b.face()).twin[static_cast<std::size_t>(b.corner())] = a;
  }
  void name_edge(Side side, int edge) {
    at(side.face()).edge[static_cast<std::size_t>(side.corner())] = edge;
  }
  void join_as(int edge, Side a, Side b);
  void replace(int edge, Side a, Side b) {
    join_as(edge, a, b);
    replaced_.push_back(edge);
  }
  void attach(Side side, Side beyond);
  void add_edge(Side a, Side b);
  void erase_edge(int edge);
  void erase_face(int f);

  using Edges = std::vector<std::array<Index, 2>>;
  void sort_by_vertex(std::size_t which, Index count, const Edges& from, Edges& to);

  std::vector<Face> faces_;
  std::vector<Side> side_of_edge_;
  std::vector<int> touched_, replaced_;
  std::vector<int> bucket_;  // scratch of list_edges
  Edges unsorted_, half_sorted_;
};

}  // namespace metamorph::core
