#include "core/ghost_mesh.h"

#include <algorithm>
#include <cassert>

namespace metamorph::core {

bool GhostMesh::connect(std::span<const std::array<Index, 3>> triangles, Index count) {
  clear();
  // Sides by the vertex they start from, as lists: side s = 3 * face + corner starts at the vertex
  // after its corner and ends at the one before it.
  const auto vertices = static_cast<std::size_t>(count);
  std::vector<int> first(vertices, -1), following(3 * triangles.size());
  for (const auto& [a, b, c] : triangles) {
    const int f = face_count();
    faces_.push_back({{a, b, c}, {-1, -1, -1}});
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
        at(f).across[static_cast<std::size_t>(corner)] = twin / 3;
      } else {
        at(f).across[static_cast<std::size_t>(corner)] = face_count();
        leaving[static_cast<std::size_t>(start)] = face_count();
        faces_.push_back({{ghost, end, start}, {f, -1, -1}});
      }
    }
  }
  for (int g = real_faces; g < face_count(); ++g) {
    const int after = leaving[static_cast<std::size_t>(vertex(g, 1))];
    at(g).across[2] = after;
    at(after).across[1] = g;
  }
  return true;
}

int GhostMesh::corner_of(int f, Index vertex) const {
  const auto& v = face(f).vertex;
  return v[0] == vertex ? 0 : v[1] == vertex ? 1 : v[2] == vertex ? 2 : -1;
}

int GhostMesh::corner_towards(int f, int g) const {
  const auto& across = face(f).across;
  return across[0] == g ? 0 : across[1] == g ? 1 : 2;
}

GhostMesh::Quadrilateral GhostMesh::around(Side side) const {
  const int g = across(side.face, side.corner);
  return {vertex(side.face, next(side.corner)), vertex(side.face, before(side.corner)),
          vertex(side.face, side.corner), vertex(g, corner_towards(g, side.face))};
}

void GhostMesh::redirect(int f, int from, int to) {
  at(f).across[static_cast<std::size_t>(corner_towards(f, from))] = to;
}

bool GhostMesh::are_neighbours(Side corner, Index other) const {
  const Index vertex = this->vertex(corner.face, corner.corner);
  int f = corner.face;
  do {
    if (corner_of(f, other) >= 0) return true;
    f = across(f, next(corner_of(f, vertex)));
  } while (f != corner.face);
  return false;
}

bool GhostMesh::flip(Side side) {
  const int f = side.face, i = side.corner;
  const int g = across(f, i), j = corner_towards(g, f);
  const auto [a, b, c, d] = around(side);
  if (are_neighbours({f, i}, d)) return false;
  const int beyond_bc = across(f, next(i)), beyond_ca = across(f, before(i));
  const int beyond_ad = across(g, next(j)), beyond_db = across(g, before(j));
  at(f) = {{c, a, d}, {beyond_ad, g, beyond_ca}};
  at(g) = {{c, d, b}, {beyond_db, beyond_bc, f}};
  redirect(beyond_ad, g, f);
  redirect(beyond_bc, f, g);
  return true;
}

void GhostMesh::split(int f, Index vertex) {
  const auto [a, b, c] = face(f).vertex;
  const auto [beyond_bc, beyond_ca, beyond_ab] = face(f).across;
  const int f1 = face_count(), f2 = f1 + 1;
  at(f) = {{a, b, vertex}, {f1, f2, beyond_ab}};
  faces_.push_back({{b, c, vertex}, {f2, f, beyond_bc}});
  faces_.push_back({{c, a, vertex}, {f, f1, beyond_ca}});
  redirect(beyond_bc, f, f1);
  redirect(beyond_ca, f, f2);
}

void GhostMesh::dissolve(Side corner) {
  const int f = corner.face, i = corner.corner;
  const Index vertex = face(f).vertex[static_cast<std::size_t>(i)];
  // f = (vertex, a, b), f1 = (vertex, b, c), f2 = (vertex, c, a)
  const int f1 = across(f, next(i)), f2 = across(f, before(i));
  const int i1 = corner_of(f1, vertex), i2 = corner_of(f2, vertex);
  const Index a = this->vertex(f, next(i)), b = this->vertex(f, before(i));
  const Index c = this->vertex(f1, before(i1));
  assert(across(f1, next(i1)) == f2);
  const int beyond_ab = across(f, i), beyond_bc = across(f1, i1), beyond_ca = across(f2, i2);
  at(f) = {{a, b, c}, {beyond_bc, beyond_ca, beyond_ab}};
  redirect(beyond_bc, f1, f);
  redirect(beyond_ca, f2, f);
  erase_face(std::max(f1, f2));
  erase_face(std::min(f1, f2));
}

void GhostMesh::erase_face(int f) {
  const int last = face_count() - 1;
  if (f != last) {
    for (const int neighbour : face(last).across) redirect(neighbour, last, f);
    at(f) = face(last);
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
  // Of the two directions of an edge one ascends. Edges are sorted into buckets by their first
  // vertex and then, few as they are, within these.
  const auto for_each_ascending = [this](const auto& visit) {
    for (const Face& face : faces_) {
      const auto [a, b, c] = face.vertex;
      if (a < b && a != ghost) visit(a, b);
      if (b < c && b != ghost) visit(b, c);
      if (c < a && c != ghost) visit(c, a);
    }
  };
  bucket_.assign(static_cast<std::size_t>(count) + 1, 0);
  for_each_ascending([this](Index i, Index) { ++bucket_[static_cast<std::size_t>(i) + 1]; });
  for (std::size_t i = 1; i < bucket_.size(); ++i) bucket_[i] += bucket_[i - 1];
  edges.resize(static_cast<std::size_t>(bucket_.back()));
  for_each_ascending([&](Index i, Index j) {
    edges[static_cast<std::size_t>(bucket_[static_cast<std::size_t>(i)]++)] = {i, j};
  });
  std::size_t start = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    const auto end = static_cast<std::size_t>(bucket_[i]);
    for (std::size_t e = start + 1; e < end; ++e) {
      const auto edge = edges[e];
      std::size_t to = e;
      for (; to > start && edges[to - 1][1] > edge[1]; --to) edges[to] = edges[to - 1];
      edges[to] = edge;
    }
    start = end;
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
