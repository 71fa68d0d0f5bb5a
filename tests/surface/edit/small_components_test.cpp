// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/edit/small_components.h"

#include <gtest/gtest.h>

#include "surface/families.h"

namespace arete {
namespace {

TEST(SmallComponents, AreLeftOutWithTheirAttributesAndCounted) {
  TriangleMesh shape = shapes::globe(12, 7);  // a diagonal of about 3.4
  const std::size_t large = shape.triangles.size(), vertices = shape.positions.size();
  shapes::append(shape, shapes::tetrahedron({9, 0, 0}));
  SurfaceMesh mesh(shape);
  Attribute number{.name = "number", .type = ScalarType::int32};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) number.append(std::vector<double>{double(t)});
  mesh.triangleAttributes = {number};
  const auto without = withoutSmallComponents(mesh, 3);
  ASSERT_TRUE(without);
  EXPECT_EQ(without->components, 1u);
  EXPECT_EQ(without->triangles, 4u);
  EXPECT_EQ(without->mesh.triangles.size(), large);
  EXPECT_EQ(without->mesh.positions.size(), vertices);
  for (std::size_t t = 0; t < large; ++t)
    EXPECT_EQ(without->mesh.triangleAttributes[0].numbers(t)[0], double(without->triangleOf[t]));
  EXPECT_TRUE(withoutSmallComponents(mesh, 100)->mesh.triangles.empty());
  EXPECT_EQ(withoutSmallComponents(mesh, 0)->mesh.triangles.size(), mesh.triangles.size());
}

TEST(DiagonalOf, IsThatOfTheVerticesThatTrianglesUse) {
  TriangleMesh mesh = shapes::sheet(3, 4);
  mesh.positions.push_back({1000, 0, 0});
  EXPECT_LT(diagonalOf(mesh), 10);
  EXPECT_EQ(diagonalOf({}), 0);
}

}  // namespace
}  // namespace arete
