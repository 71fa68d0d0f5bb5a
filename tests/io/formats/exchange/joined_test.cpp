// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/exchange/joined.h"

#include <gtest/gtest.h>

#include <array>

#include "surface/shapes.h"

namespace arete {
namespace {

/// Every triangle with corners of its own.
MeshFile soupOf(const TriangleMesh& mesh) {
  MeshFile file;
  for (const auto& triangle : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(file.mesh.positions.size());
    file.mesh.triangles.push_back({first, first + 1, first + 2});
    for (const std::uint32_t v : triangle) file.mesh.positions.push_back(mesh.positions[v]);
  }
  return file;
}

TEST(JoinSoup, GivesTheMeshBackThatTheSoupWasMadeOf) {
  const TriangleMesh mesh = shapes::sheet(7, 5, true, true);
  MeshFile file = soupOf(mesh);
  const std::size_t corners = file.mesh.positions.size();
  ASSERT_TRUE(joinSoup(file));
  EXPECT_EQ(file.mesh.positions.size(), mesh.positions.size());
  EXPECT_EQ(file.joinedVertices, corners - mesh.positions.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_EQ(file.mesh.positions[file.mesh.triangles[t][i]], mesh.positions[mesh.triangles[t][i]]);
}

TEST(JoinSoup, TwoCubesThatTouchInAnEdgeStayTwo) {
  TriangleMesh mesh = shapes::tetrahedron();
  shapes::append(mesh, shapes::tetrahedron({0, 0, 1}));  // they share a vertex
  MeshFile file = soupOf(mesh);
  ASSERT_TRUE(joinSoup(file));
  EXPECT_EQ(file.mesh.positions.size(), 8u);
}

TEST(JoinSoup, ObjectsAreNotJoinedWithEachOther) {
  MeshFile file = soupOf(shapes::sheet(1, 1));
  file.mesh.objects = {"a", "b"};
  file.mesh.objectOf = {0, 1};
  ASSERT_TRUE(joinSoup(file));
  EXPECT_EQ(file.mesh.positions.size(), 6u);
}

TEST(JoinSoup, CornersThatDifferStayApartInTheirAttributes) {
  MeshFile file = soupOf(shapes::sheet(2, 2));
  Attribute quality{.name = "quality", .type = ScalarType::float32};
  Attribute height{.name = "height", .type = ScalarType::float32};
  for (std::size_t v = 0; v < file.mesh.positions.size(); ++v) {
    const double number = double(v), x = file.mesh.positions[v].x;
    quality.append(std::span(&number, 1));
    height.append(std::span(&x, 1));
  }
  file.mesh.vertexAttributes = {quality, height};
  ASSERT_TRUE(joinSoup(file));
  EXPECT_TRUE(file.mesh.validate());
  EXPECT_EQ(file.mesh.positions.size(), 9u);
  ASSERT_EQ(file.mesh.wedgeAttributes.size(), 1u);
  EXPECT_EQ(file.mesh.wedgeAttributes[0].name, "quality");
  ASSERT_EQ(file.mesh.vertexAttributes.size(), 1u) << "heights agree at every vertex";
  for (std::size_t c = 0; c < 24; ++c)
    EXPECT_EQ(file.mesh.wedgeAttributes[0].numbers(file.mesh.wedges[c / 3][c % 3])[0], double(c));
}

TEST(JoinSoup, AMeshThatSharesVerticesStaysAsItIs) {
  MeshFile file;
  file.mesh.shape() = shapes::sheet(2, 2);
  const SurfaceMesh before = file.mesh;
  ASSERT_TRUE(joinSoup(file));
  EXPECT_EQ(file.mesh, before);
}

}  // namespace
}  // namespace arete
