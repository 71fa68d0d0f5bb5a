// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/decimate/contraction_mesh.h"

#include <gtest/gtest.h>

#include "surface/shapes.h"

namespace arete {
namespace {

std::vector<std::uint32_t> list(std::initializer_list<std::uint32_t> vertices) {
  return vertices;
}

TEST(ContractionMesh, KeepsATetrahedron) {
  const ContractionMesh mesh(shapes::tetrahedron({0, 0, 0}));
  for (std::uint32_t v = 1; v < 4; ++v) EXPECT_FALSE(mesh.keepsTopology(list({0, v})));
}

TEST(ContractionMesh, ClosesNoHoleOfThreeVerticesAndPinchesNoBorder) {
  // A hexagon of six triangles around a hole of three: its inner vertices are 0, 1, 2.
  TriangleMesh ring;
  ring.positions = {{0, 1, 0}, {-1, -1, 0}, {1, -1, 0}, {0, 3, 0}, {-3, -3, 0}, {3, -3, 0}};
  ring.triangles = {{0, 3, 1}, {3, 4, 1}, {1, 4, 2}, {4, 5, 2}, {2, 5, 0}, {5, 3, 0}};
  const ContractionMesh mesh(ring);
  EXPECT_FALSE(mesh.keepsTopology(list({0, 1})));  // 2 is a common neighbour without a triangle
  // Across the ring: both ends are on borders, the edge is not.
  EXPECT_FALSE(mesh.keepsTopology(list({0, 3})));
}

TEST(ContractionMesh, ContractsEdgesAndTrianglesOfASheet) {
  const TriangleMesh sheet = shapes::sheet(6, 6);
  ContractionMesh mesh(sheet);
  const auto inner = [&](double x, double y) {
    for (std::uint32_t v = 0; v < sheet.positions.size(); ++v)
      if (sheet.positions[v].x == x && sheet.positions[v].y == y) return v;
    throw std::runtime_error("no such vertex");
  };
  const std::uint32_t a = inner(2, 2), b = inner(3, 2);
  ASSERT_TRUE(mesh.keepsTopology(list({a, b})));
  ASSERT_TRUE(mesh.keepsTurns(list({a, b}), {2.5, 2, 0}));
  EXPECT_FALSE(mesh.keepsTurns(list({a, b}), {2.5, 9, 0}));
  const std::uint32_t before = mesh.triangleCount();
  mesh.contract(list({a, b}), {2.5, 2, 0});
  EXPECT_EQ(mesh.triangleCount(), before - 2);
  EXPECT_TRUE(mesh.trianglesOf(b).empty());
  EXPECT_EQ(mesh.position(a), (Vec3{2.5, 2, 0}));
  std::size_t left = 0;
  mesh.forLeft(list({a, inner(2, 3)}), [&](std::uint32_t t, std::size_t corner) {
    EXPECT_TRUE(mesh.corners(t)[corner] == a || mesh.corners(t)[corner] == inner(2, 3));
    ++left;
  });
  EXPECT_EQ(left, mesh.trianglesOf(a).size() + mesh.trianglesOf(inner(2, 3)).size() - 4);
}

TEST(ContractionMesh, LeavesOutTrianglesThatWouldBeThereTwice) {
  // Two sheets of one triangle each, whose corners 0 and 3 are contracted.
  TriangleMesh two;
  two.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0.1}};
  two.triangles = {{0, 1, 2}, {3, 1, 2}};
  ContractionMesh mesh(two);
  mesh.contract(list({0, 3}), {0, 0, 0});
  EXPECT_EQ(mesh.triangleCount(), 1u);
}

}  // namespace
}  // namespace arete
