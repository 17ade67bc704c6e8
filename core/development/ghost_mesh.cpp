#include "core/development/ghost_mesh.h"

#include <algorithm>
#include <cassert>
#include <functional>

namespace metamorph::core {

void GhostMesh::clear() {
  faces_.clear();
  side_of_edge_.clear();
  forget_changes();
}

bool GhostMesh::connect(std::span<const std::array<Index, 3>> triangles, Index count) {
  clear();
  // Sides by the vertex they start from, as lists: side s = 3 * face + corner starts at the vertex
  // after its corner and ends at the one before it.
  const auto vertices = static_cast<std::size_t>(count);
  std::vector<int> first(vertices, -1), following(3 * triangles.size());
  for (const auto& [a, b, c] : triangles) {
    const int f = face_count();
    faces_.push_back({{a, b, c}, {}, {}});
    for (int corner = 0; corner < 3; ++corner) {
      const auto start = static_cast<std::size_t>(vertex(f, next(corner)));
      following[static_cast<std::size_t>(3 * f + corner)] = first[start];
      first[start] = 3 * f + corner;
    }
  }
  if (triangles.empty() || std::find(first.begin(), first.end(), -1) != first.end()) {
    clear();
    return false;
  }
  const int real_faces = face_count();
  std::vector<int> leaving(vertices, -1);  // ghost face behind the hull edge that starts here
  for (int f = 0; f < real_faces; ++f) {
    for (int corner = 0; corner < 3; ++corner) {
      const Index start = vertex(f, next(corner)), end = vertex(f, before(corner));
      int twin = first[static_cast<std::size_t>(end)];
      while (twin >= 0 && vertex(twin / 3, before(twin % 3)) != start) {
        twin = following[static_cast<std::size_t>(twin)];
      }
      if (twin >= 0) {
        join({f, corner}, {twin / 3, twin % 3});
      } else {
        leaving[static_cast<std::size_t>(start)] = face_count();
        faces_.push_back({{ghost, end, start}, {}, {}});
        join({f, corner}, {face_count() - 1, 0});
      }
    }
  }
  for (int g = real_faces; g < face_count(); ++g) {
    join({g, 2}, {leaving[static_cast<std::size_t>(vertex(g, 1))], 1});
  }
  for (int f = 0; f < face_count(); ++f) {
    for (int corner = 0; corner < 3; ++corner) {
      const Side side = {f, corner};
      if (side.code < twin(side).code) add_edge(side, twin(side));
    }
  }
  forget_changes();
  return true;
}

void GhostMesh::join_as(int edge, Side a, Side b) {
  join(a, b);
  name_edge(a, edge);
  name_edge(b, edge);
  side_of_edge_[static_cast<std::size_t>(edge)] = a;
  touched_.push_back(edge);
}

/// Makes a side the other one of the edge that `beyond` belongs to.
void GhostMesh::attach(Side side, Side beyond) { join_as(edge(beyond), side, beyond); }

void GhostMesh::add_edge(Side a, Side b) {
  side_of_edge_.emplace_back();
  replace(edge_count() - 1, a, b);
}

/// Gives the number of an edge that is gone to the last one.
void GhostMesh::erase_edge(int edge) {
  const int last = edge_count() - 1;
  if (edge != last) {
    const Side side = side_of(last);
    replace(edge, side, twin(side));
  }
  replaced_.push_back(last);
  side_of_edge_.pop_back();
}

bool GhostMesh::are_neighbours(Side corner, Index other) const {
  const Index vertex = this->vertex(corner.face(), corner.corner());
  int f = corner.face();
  do {
    if (corner_of(f, other) >= 0) return true;
    f = across(f, next(corner_of(f, vertex)));
  } while (f != corner.face());
  return false;
}

bool GhostMesh::flip(Side side) {
  const auto [a, b, c, d] = around(side);
  if (are_neighbours(side, d)) return false;
  const int f = side.face(), i = side.corner();
  const int g = twin(side).face(), j = twin(side).corner();
  const Side beyond_bc = twin({f, next(i)}), beyond_ca = twin({f, before(i)});
  const Side beyond_ad = twin({g, next(j)}), beyond_db = twin({g, before(j)});
  const int edge = this->edge(side);
  at(f).vertex = {c, a, d};
  at(g).vertex = {c, d, b};
  attach({f, 0}, beyond_ad);
  replace(edge, {f, 1}, {g, 2});
  attach({f, 2}, beyond_ca);
  attach({g, 0}, beyond_db);
  attach({g, 1}, beyond_bc);
  return true;
}

void GhostMesh::split(int f, Index vertex) {
  const auto [a, b, c] = face(f).vertex;
  const auto [beyond_bc, beyond_ca, beyond_ab] = face(f).twin;
  const int f1 = face_count(), f2 = f1 + 1;
  at(f).vertex = {a, b, vertex};
  faces_.push_back({{b, c, vertex}, {}, {}});
  faces_.push_back({{c, a, vertex}, {}, {}});
  add_edge({f, 0}, {f1, 1});
  add_edge({f1, 0}, {f2, 1});
  add_edge({f2, 0}, {f, 1});
  attach({f, 2}, beyond_ab);
  attach({f1, 2}, beyond_bc);
  attach({f2, 2}, beyond_ca);
}

void GhostMesh::dissolve(Side corner) {
  const int f = corner.face(), i = corner.corner();
  const Index vertex = this->vertex(f, i);
  // f = (vertex, a, b), f1 = (vertex, b, c), f2 = (vertex, c, a)
  const int f1 = across(f, next(i)), f2 = across(f, before(i));
  const int i1 = corner_of(f1, vertex), i2 = corner_of(f2, vertex);
  assert(across(f1, next(i1)) == f2);
  const Index a = this->vertex(f, next(i)), b = this->vertex(f, before(i));
  const Index c = this->vertex(f1, before(i1));
  const Side beyond_ab = twin(corner), beyond_bc = twin({f1, i1}), beyond_ca = twin({f2, i2});
  std::array<int, 3> spokes = {edge({f, next(i)}), edge({f, before(i)}), edge({f1, next(i1)})};
  std::sort(spokes.begin(), spokes.end(), std::greater<>());
  at(f).vertex = {a, b, c};
  attach({f, 0}, beyond_bc);
  attach({f, 1}, beyond_ca);
  attach({f, 2}, beyond_ab);
  for (const int spoke : spokes) erase_edge(spoke);
  erase_face(std::max(f1, f2));
  erase_face(std::min(f1, f2));
}

void GhostMesh::erase_face(int f) {
  const int last = face_count() - 1;
  if (f != last) {
    at(f).vertex = face(last).vertex;
    for (int i = 0; i < 3; ++i) attach({f, i}, twin({last, i}));
  }
  faces_.pop_back();
}

void GhostMesh::rename(std::span<const Index> name) {
  for (Face& face : faces_) {
    for (Index& vertex : face.vertex) {
      if (vertex != ghost) vertex = name[static_cast<std::size_t>(vertex)];
    }
  }
}

void GhostMesh::list_edges(Index count, std::vector<std::array<Index, 2>>& edges) {
  // Of an edge's two directions one ascends. Written so that nothing branches on which: the edges
  // are collected, then sorted by their second vertices and, stably, by their first, counting.
  unsorted_.resize(3 * faces_.size());
  std::size_t found = 0;
  const auto collect = [&](Index i, Index j) {
    unsorted_[found] = {i, j};
    found += static_cast<std::size_t>((i < j) & (i != ghost));
  };
  for (const Face& face : faces_) {
    const auto [a, b, c] = face.vertex;
    collect(a, b);
    collect(b, c);
    collect(c, a);
  }
  unsorted_.resize(found);
  edges.resize(found);
  half_sorted_.resize(found);
  sort_by_vertex(1, count, unsorted_, half_sorted_);
  sort_by_vertex(0, count, half_sorted_, edges);
}

/// Counting sort by one of the two vertices; keeps the order of edges in which it is the same.
void GhostMesh::sort_by_vertex(std::size_t which, Index count, const Edges& from, Edges& to) {
  bucket_.assign(static_cast<std::size_t>(count) + 1, 0);
  for (const auto& edge : from) ++bucket_[static_cast<std::size_t>(edge[which]) + 1];
  for (std::size_t i = 1; i < bucket_.size(); ++i) bucket_[i] += bucket_[i - 1];
  for (const auto& edge : from) {
    to[static_cast<std::size_t>(bucket_[static_cast<std::size_t>(edge[which])]++)] = edge;
  }
}

void GhostMesh::list_faces(std::vector<std::array<Index, 3>>& faces) const {
  faces.clear();
  for (Face face : faces_) {
    auto& v = face.vertex;
    std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
    if (v[0] != ghost) faces.push_back(v);
  }
  std::sort(faces.begin(), faces.end());
}

}  // namespace metamorph::core
