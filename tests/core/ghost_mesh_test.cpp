#include "core/development/ghost_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

namespace metamorph::core {
namespace {

using Faces = std::vector<std::array<Index, 3>>;
using Edges = std::vector<std::array<Index, 2>>;

/// A square 0, 1, 2, 3 with its centre 4.
const Faces fan = {{0, 1, 4}, {0, 4, 3}, {1, 2, 4}, {2, 3, 4}};

void expect_sound(const GhostMesh& mesh) {
  for (int f = 0; f < mesh.face_count(); ++f) {
    for (int i = 0; i < 3; ++i) {
      const int g = mesh.twin({f, i}).face(), j = mesh.twin({f, i}).corner();
      ASSERT_EQ(mesh.twin({g, j}).code, GhostMesh::Side(f, i).code);
      EXPECT_EQ(mesh.vertex(f, GhostMesh::next(i)), mesh.vertex(g, GhostMesh::before(j)));
      EXPECT_EQ(mesh.vertex(f, GhostMesh::before(i)), mesh.vertex(g, GhostMesh::next(j)));
      const int edge = mesh.edge({f, i});
      EXPECT_EQ(mesh.edge({g, j}), edge);
      ASSERT_LT(edge, mesh.edge_count());
      const auto side = mesh.side_of(edge).code;
      EXPECT_TRUE(side == GhostMesh::Side(f, i).code || side == GhostMesh::Side(g, j).code);
    }
  }
  EXPECT_EQ(2 * mesh.edge_count(), 3 * mesh.face_count());
}

Faces faces_of(const GhostMesh& mesh) {
  Faces faces;
  mesh.list_faces(faces);
  return faces;
}

/// The side of the first face that has it, by the edge's two vertices.
GhostMesh::Side side_of(const GhostMesh& mesh, Index a, Index b) {
  for (int f = 0; f < mesh.face_count(); ++f) {
    for (int i = 0; i < 3; ++i) {
      if (mesh.vertex(f, GhostMesh::next(i)) == a && mesh.vertex(f, GhostMesh::before(i)) == b) {
        return {f, i};
      }
    }
  }
  return {0, 3};
}

TEST(GhostMesh, ConnectsFacesAndClosesTheOutside) {
  GhostMesh mesh;
  ASSERT_TRUE(mesh.connect(fan, 5));
  EXPECT_EQ(mesh.face_count(), 2 * (5 + 1) - 4);  // Euler's formula with the ghost as a vertex
  expect_sound(mesh);
  EXPECT_EQ(faces_of(mesh), fan);
  Edges edges;
  mesh.list_edges(5, edges);
  EXPECT_EQ(edges, (Edges{{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 4}, {2, 3}, {2, 4}, {3, 4}}));
}

TEST(GhostMesh, RefusesFacesThatLeaveAVertexOut) {
  GhostMesh mesh;
  EXPECT_FALSE(mesh.connect(fan, 6));
  EXPECT_TRUE(mesh.empty());
  EXPECT_FALSE(mesh.connect({}, 0));
}

TEST(GhostMesh, AFlipExchangesTheDiagonalAndTwoMoreUndoIt) {
  GhostMesh mesh;
  mesh.connect(fan, 5);
  ASSERT_TRUE(mesh.flip(side_of(mesh, 4, 0)));
  expect_sound(mesh);
  EXPECT_EQ(faces_of(mesh), (Faces{{0, 1, 3}, {1, 2, 4}, {1, 4, 3}, {2, 3, 4}}));
  ASSERT_TRUE(mesh.flip(side_of(mesh, 1, 3)));
  expect_sound(mesh);
  EXPECT_EQ(faces_of(mesh), fan);
}

TEST(GhostMesh, AFlipOfAHullEdgeOpensTheFaceBehindIt) {
  GhostMesh mesh;
  mesh.connect(fan, 5);
  ASSERT_TRUE(mesh.flip(side_of(mesh, 0, 1)));
  expect_sound(mesh);
  EXPECT_EQ(faces_of(mesh), (Faces{{0, 4, 3}, {1, 2, 4}, {2, 3, 4}}));
}

TEST(GhostMesh, RefusesAFlipThatWouldDoubleAnEdge) {
  GhostMesh mesh;
  mesh.connect(fan, 5);
  mesh.flip(side_of(mesh, 4, 0));  // 4 is left with 1, 2 and 3
  EXPECT_FALSE(mesh.flip(side_of(mesh, 4, 2)));
  expect_sound(mesh);
}

TEST(GhostMesh, SplitAndDissolveAreOpposites) {
  for (const bool outside : {false, true}) {
    GhostMesh mesh;
    mesh.connect(fan, 5);
    const auto side = outside ? side_of(mesh, 1, 0) : side_of(mesh, 0, 1);
    mesh.split(side.face(), 5);
    expect_sound(mesh);
    EXPECT_EQ(mesh.face_count(), 10);
    EXPECT_EQ(faces_of(mesh).size(), outside ? 5u : 6u);
    const int last = mesh.face_count() - 1;
    EXPECT_EQ(mesh.corner_of(last, 5), 2);
    mesh.dissolve({last, 2});
    expect_sound(mesh);
    EXPECT_EQ(faces_of(mesh), fan);
  }
}

/// An edge's two ends and the third corners of its faces, each pair ascending.
std::array<Index, 4> corners_of(const GhostMesh& mesh, int edge) {
  const auto q = mesh.around(mesh.side_of(edge));
  return {std::min(q.a, q.b), std::max(q.a, q.b), std::min(q.c, q.d), std::max(q.c, q.d)};
}

TEST(GhostMesh, TellsWhichEdgesChanged) {
  GhostMesh mesh;
  mesh.connect(fan, 5);
  const auto change = [&](const auto& act) {
    std::vector<std::array<Index, 4>> before;
    for (int e = 0; e < mesh.edge_count(); ++e) before.push_back(corners_of(mesh, e));
    mesh.forget_changes();
    act();
    const auto told = [](std::span<const int> edges, int e) {
      return std::find(edges.begin(), edges.end(), e) != edges.end();
    };
    for (int e = 0; e < std::max(mesh.edge_count(), static_cast<int>(before.size())); ++e) {
      const bool was = e < static_cast<int>(before.size()), is = e < mesh.edge_count();
      const auto& old = was ? before[static_cast<std::size_t>(e)] : std::array<Index, 4>{};
      const auto now = is ? corners_of(mesh, e) : std::array<Index, 4>{};
      if (was != is || old[0] != now[0] || old[1] != now[1]) {
        EXPECT_TRUE(told(mesh.replaced(), e)) << e;
      }
      if (is && (!was || old != now)) {
        EXPECT_TRUE(told(mesh.touched(), e)) << e;
      }
    }
  };
  change([&] { mesh.split(side_of(mesh, 0, 1).face(), 5); });
  change([&] { mesh.split(side_of(mesh, 1, 2).face(), 6); });
  change([&] {
    int f = 0;
    while (mesh.corner_of(f, 5) < 0) ++f;
    mesh.dissolve({f, mesh.corner_of(f, 5)});
  });
  change([&] { mesh.flip(side_of(mesh, 4, 0)); });
  change([&] { mesh.flip(side_of(mesh, 1, 2)); });
  EXPECT_FALSE(mesh.replaced().empty());
  expect_sound(mesh);
}

TEST(GhostMesh, RenamesVertices) {
  GhostMesh mesh;
  mesh.connect(fan, 5);
  mesh.rename(std::vector<Index>{4, 3, 2, 1, 0});
  EXPECT_EQ(faces_of(mesh), (Faces{{0, 1, 4}, {0, 2, 1}, {0, 3, 2}, {0, 4, 3}}));
}

}  // namespace
}  // namespace metamorph::core
