// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/edit/joined_surface.h"

#include <gtest/gtest.h>

#include "surface/model/wedges.h"
#include "surface/shapes.h"

namespace arete {
namespace {

/// Two squares side by side that repeat their two common vertices, where `u` differs and `v` does not.
SurfaceMesh cutApart() {
  SurfaceMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
  Attribute u{.name = "u"}, v{.name = "v"};
  for (const double x : {0., 0.5, 0.5, 0., 0.6, 1., 1., 0.6}) u.append(std::vector<double>{x});
  for (const double x : {1., 2., 3., 4., 2., 5., 6., 3.}) v.append(std::vector<double>{x});
  mesh.vertexAttributes = {u, v};
  return mesh;
}

TEST(JoinSurface, SaysOfCornersWhatDiffers) {
  SurfaceMesh mesh = cutApart();
  const SurfaceMesh before = mesh;
  const auto joined = joinSurface(mesh);
  ASSERT_TRUE(joined);
  EXPECT_EQ(joined->joinedVertices, 2u);
  EXPECT_EQ(joined->vertexOf, (std::vector<std::uint32_t>{0, 1, 2, 3, 5, 6}));
  ASSERT_TRUE(mesh.validate());
  ASSERT_EQ(mesh.wedgeAttributes.size(), 1u);
  EXPECT_EQ(mesh.wedgeAttributes[0].name, "u");
  ASSERT_EQ(mesh.vertexAttributes.size(), 1u);
  EXPECT_EQ(mesh.vertexAttributes[0].name, "v");
  EXPECT_EQ(mesh.wedgeCount, 8u);
  EXPECT_EQ(countSeamEdges(mesh), 1u);
  // Split again, every corner is as it was.
  const SurfaceMesh split = splitByWedges(mesh).mesh;
  for (std::size_t t = 0; t < 4; ++t)
    for (std::size_t i = 0; i < 3; ++i)
      for (const Attribute& attribute : before.vertexAttributes) {
        const auto& now = split.vertexAttributes[split.vertexAttributes[0].name == attribute.name ? 0 : 1];
        EXPECT_EQ(now.numbers(split.triangles[t][i]), attribute.numbers(before.triangles[t][i]));
      }
}

TEST(JoinSurface, LeavesAMeshAloneThatHasNothingToJoin) {
  SurfaceMesh mesh = cutApart();
  for (std::size_t v = 4; v < 8; ++v) mesh.positions[v].z = 1;
  const SurfaceMesh before = mesh;
  const auto joined = joinSurface(mesh);
  ASSERT_TRUE(joined);
  EXPECT_EQ(joined->joinedVertices, 0u);
  EXPECT_TRUE(mesh == before);
}

TEST(JoinSurface, KeepsObjectsApart) {
  SurfaceMesh mesh = cutApart();
  mesh.objects = {"a", "b"};
  mesh.objectOf = {0, 0, 1, 1};
  const auto joined = joinSurface(mesh, {.partOf = mesh.objectOf});
  ASSERT_TRUE(joined);
  EXPECT_EQ(joined->joinedVertices, 0u);
}

TEST(CountSeamEdges, CountsEdgesWithDifferentWedgesAtAnyEnd) {
  SurfaceMesh mesh;
  static_cast<TriangleMesh&>(mesh) = shapes::sheet(1, 1);  // two triangles
  EXPECT_EQ(countSeamEdges(mesh), 0u);
  mesh.wedgeCount = 6;
  mesh.wedges = mesh.triangles;
  EXPECT_EQ(countSeamEdges(mesh), 0u);
  mesh.wedges[1][0] = 5;  // at one end of the diagonal
  EXPECT_EQ(countSeamEdges(mesh), 1u);
  mesh.triangles[1] = {mesh.triangles[1][0], mesh.triangles[1][2], mesh.triangles[1][1]};
  mesh.wedges[1] = {5, mesh.wedges[1][2], mesh.wedges[1][1]};
  EXPECT_EQ(countSeamEdges(mesh), 1u) << "also where neighbours turn against each other";
}

}  // namespace
}  // namespace arete
