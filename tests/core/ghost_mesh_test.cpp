#include "core/ghost_mesh.h"

#include <gtest/gtest.h>

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
    }
  }
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

TEST(GhostMesh, RenamesVertices) {
  GhostMesh mesh;
  mesh.connect(fan, 5);
  mesh.rename(std::vector<Index>{4, 3, 2, 1, 0});
  EXPECT_EQ(faces_of(mesh), (Faces{{0, 1, 4}, {0, 2, 1}, {0, 3, 2}, {0, 4, 3}}));
}

}  // namespace
}  // namespace metamorph::core
