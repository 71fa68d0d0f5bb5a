// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/model/transfer.h"

#include <gtest/gtest.h>

#include <numeric>

#include "surface/repair/repair.h"
#include "surface/repair/weld.h"
#include "surface/shapes.h"

namespace arete {
namespace {

Attribute numbered(const char* name, ScalarType type, std::size_t elements,
                   AttributeMeaning meaning = AttributeMeaning::other) {
  Attribute a{.name = name, .meaning = meaning, .type = type};
  for (std::size_t i = 0; i < elements; ++i) a.append(std::vector<double>{double(7 * i % 101)});
  return a;
}

/// A sheet in which every triangle has wedges of its own at its corners, with
/// an attribute of each kind.
SurfaceMesh everything() {
  SurfaceMesh mesh;
  mesh.shape() = shapes::sheet(4, 3);
  const auto triangles = static_cast<std::uint32_t>(mesh.triangles.size());
  mesh.vertexAttributes = {numbered("quality", ScalarType::float64, mesh.positions.size())};
  mesh.triangleAttributes = {numbered("label", ScalarType::int16, triangles)};
  mesh.wedgeCount = 3 * triangles;
  for (std::uint32_t t = 0; t < triangles; ++t) {
    mesh.wedges.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    mesh.objectOf.push_back(t % 2);
    mesh.materialOf.push_back(t % 3 == 2 ? SurfaceMesh::kNone : t % 3);
  }
  mesh.wedgeAttributes = {
      numbered("u", ScalarType::float32, mesh.wedgeCount, AttributeMeaning::textureCoords),
      numbered("chart", ScalarType::uint8, mesh.wedgeCount)};
  mesh.objects = {"odd", "even"};
  mesh.materials = {{.name = "stone"}, {.name = "grass"}};
  return mesh;
}

double cornerNumber(const SurfaceMesh& mesh, std::size_t attribute, std::size_t triangle,
                    std::size_t corner) {
  return mesh.wedgeAttributes[attribute].numbers(mesh.wedges[triangle][corner])[0];
}

TEST(TransferAttributes, ToTheSameShapeGivesTheSameMesh) {
  const SurfaceMesh mesh = everything();
  ASSERT_TRUE(mesh.validate());
  std::vector<std::uint32_t> vertexOf(mesh.positions.size()), triangleOf(mesh.triangles.size());
  std::iota(vertexOf.begin(), vertexOf.end(), 0u);
  std::iota(triangleOf.begin(), triangleOf.end(), 0u);
  auto same = transferAttributes(mesh, mesh, vertexOf, triangleOf);
  ASSERT_TRUE(same);
  EXPECT_EQ(same->faceOf, triangleOf);
  same->faceOf.clear();
  EXPECT_TRUE(*same == mesh);
}

TEST(TransferAttributes, OfATurnedTriangleGoToTheCornersThatItHas) {
  SurfaceMesh mesh = everything();
  for (const std::size_t t : {1u, 9u}) {
    std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
    std::swap(mesh.wedges[t][1], mesh.wedges[t][2]);
  }
  const auto repaired = repair(mesh);
  ASSERT_TRUE(repaired);
  ASSERT_EQ(repaired->counts.turnedTriangles, 2u);
  const auto carried = transferAttributes(mesh, repaired->mesh, repaired->vertexOf, repaired->triangleOf);
  ASSERT_TRUE(carried);
  const SurfaceMesh expected = everything();
  for (std::size_t t = 0; t < expected.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i)
      for (const std::size_t a : {0u, 1u})
        EXPECT_EQ(cornerNumber(*carried, a, t, i), cornerNumber(expected, a, t, i));
}

TEST(TransferAttributes, AtASplitEdgeAreAveragesAndLabelsOfTheNearestCorner) {
  SurfaceMesh mesh;  // one triangle above a long edge, two below it that meet at
                     // three quarters of it
  mesh.positions = {{0, 0, 0}, {4, 0, 0}, {2, 2, 0}, {3, 0, 0}, {2, -2, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 4, 3}, {3, 4, 1}};
  mesh.wedgeCount = 9;
  mesh.wedges = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}};
  Attribute u{.name = "u", .meaning = AttributeMeaning::textureCoords, .type = ScalarType::float64};
  Attribute label{.name = "label", .type = ScalarType::int32};
  for (const double x : {10.0, 20.0, 30.0, 0.0, 0.0, 0.5, 0.25, 0.0, 0.0}) u.append(std::vector<double>{x});
  for (int i = 0; i < 9; ++i) label.append(std::vector<double>{100.0 + i});
  mesh.wedgeAttributes = {u, label};
  const auto repaired = repair(mesh);
  ASSERT_TRUE(repaired);
  ASSERT_EQ(repaired->counts.tJunctions, 1u);
  const auto carried = transferAttributes(mesh, repaired->mesh, repaired->vertexOf, repaired->triangleOf);
  ASSERT_TRUE(carried);
  ASSERT_TRUE(carried->validate());
  int split = 0;
  for (std::size_t t = 0; t < carried->triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      if (repaired->vertexOf[carried->triangles[t][i]] != 3) continue;
      if (repaired->triangleOf[t] != 0) {
        EXPECT_EQ(cornerNumber(*carried, 0, t, i), repaired->triangleOf[t] == 1 ? 0.5 : 0.25) << "to the bit";
        continue;
      }
      ++split;
      EXPECT_DOUBLE_EQ(cornerNumber(*carried, 0, t, i), 17.5);
      EXPECT_EQ(cornerNumber(*carried, 1, t, i), 101) << "of the corner at three quarters, nearest to it";
    }
  EXPECT_EQ(split, 2);
}

TEST(TransferAttributes, OfWeldedVerticesStayWithTheirCorners) {
  const SurfaceMesh mesh = everything();
  SurfaceMesh soup = mesh;
  soup.shape() = {};
  soup.vertexAttributes.clear();
  for (const auto& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.positions.size());
    soup.triangles.push_back({first, first + 1, first + 2});
    for (const std::uint32_t v : t) soup.positions.push_back(mesh.positions[v]);
  }
  const auto welded = weld(soup);
  ASSERT_TRUE(welded);
  std::vector<std::uint32_t> triangleOf(soup.triangles.size());
  std::iota(triangleOf.begin(), triangleOf.end(), 0u);
  const auto carried = transferAttributes(soup, welded->mesh, welded->vertexOf, triangleOf);
  ASSERT_TRUE(carried);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_EQ(cornerNumber(*carried, 0, t, i), cornerNumber(mesh, 0, t, i));
}

TEST(TransferAttributes, OfAFilledHoleAreThoseAroundIt) {
  SurfaceMesh mesh = everything();
  mesh.shape() = shapes::sheet(4, 3, true);
  ASSERT_EQ(mesh.triangles.size(), everything().triangles.size());
  mesh.vertexAttributes.clear();
  const auto repaired = repair(mesh, {.mostHoleEdges = 4});
  ASSERT_TRUE(repaired);
  ASSERT_EQ(repaired->counts.fillingTriangles, 4u);
  const auto carried = transferAttributes(mesh, repaired->mesh, repaired->vertexOf, repaired->triangleOf);
  ASSERT_TRUE(carried);
  EXPECT_TRUE(carried->validate());
  EXPECT_EQ(carried->materialOf.back(), SurfaceMesh::kNone);
  EXPECT_LT(carried->wedges.back()[0], carried->wedgeCount);
}

TEST(TransferAttributes, RefusesSourcesThatDoNotFit) {
  const SurfaceMesh mesh = everything();
  const std::vector<std::uint32_t> few(3, 0), triangleOf(mesh.triangles.size(), 0);
  EXPECT_FALSE(transferAttributes(mesh, mesh, few, triangleOf));
  const std::vector<std::uint32_t> far(mesh.positions.size(), 1000);
  EXPECT_FALSE(transferAttributes(mesh, mesh, far, triangleOf));
}

}  // namespace
}  // namespace arete
