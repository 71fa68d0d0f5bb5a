// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/attributes/attribute_changes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace arete {
namespace {

Attribute numbers(std::string name, AttributeMeaning meaning, std::uint8_t components,
                  const std::vector<double>& values) {
  Attribute made;
  made.name = std::move(name);
  made.meaning = meaning;
  made.type = ScalarType::float64;
  made.components = components;
  for (std::size_t i = 0; i < values.size(); i += components)
    made.append(std::span(values).subspan(i, components));
  return made;
}

/// A strip of two squares of two triangles each.
SurfaceMesh strip() {
  SurfaceMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}};
  mesh.triangles = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}};
  return mesh;
}

/// The whole of it in two triangles.
SurfaceMesh halves() {
  SurfaceMesh mesh;
  mesh.positions = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

TEST(AttributeChanges, OfAMeshAndItselfAreNone) {
  SurfaceMesh mesh = strip();
  mesh.vertexAttributes = {numbers("texcoord", AttributeMeaning::textureCoords, 2,
                                   {.1, .2, .3, .4, .5, .6, .7, .8, .9, 1, 1.1, 1.2})};
  mesh.triangleAttributes = {numbers("label", AttributeMeaning::other, 1, {1, 1, 2, 3})};
  mesh.materials = {{.name = "a"}, {.name = "b"}};
  mesh.materialOf = {0, 0, 1, MeshAttributes::kNone};
  const auto found = attributeChanges(mesh, mesh, std::array<std::uint32_t, 4>{0, 1, 2, 3});
  ASSERT_EQ(found.size(), 3);
  EXPECT_EQ(found[0].name, "uv");
  EXPECT_LT(found[0].largest, 1e-15);
  for (const AttributeChange& change : found) {
    EXPECT_EQ(change.compared, 4) << change.name;
    EXPECT_EQ(change.unequal, 0) << change.name;
  }
  EXPECT_TRUE(found[2].isEquality);
}

TEST(AttributeChanges, AreTheLargestOverTheMiddlesOfFaces) {
  SurfaceMesh fine = strip(), coarse = halves();
  // A ridge along x = 1 that the coarse one has lost: at the middles it is 255 * 1 / 3 or * 2 / 3 high.
  fine.vertexAttributes = {
      numbers("color", AttributeMeaning::color, 3, {0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0})};
  coarse.vertexAttributes = {
      numbers("color", AttributeMeaning::color, 3, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0})};
  const auto found = attributeChanges(fine, coarse, std::array<std::uint32_t, 4>{0, 1, 0, 1});
  ASSERT_EQ(found.size(), 1);
  EXPECT_EQ(found[0].unit, "255ths");
  EXPECT_NEAR(found[0].largest, 170, 1e-9);
  // A face without a triangle is not compared.
  const auto some = attributeChanges(
      fine, coarse, std::array<std::uint32_t, 4>{0, MeshAttributes::kNone, MeshAttributes::kNone, 1});
  EXPECT_EQ(some[0].compared, 2);
}

TEST(AttributeChanges, CountFacesOfAnotherMaterialByName) {
  SurfaceMesh fine = strip(), coarse = halves();
  fine.materials = {{.name = "a"}, {.name = "b"}};
  fine.materialOf = {0, 0, 1, 1};
  coarse.materials = {{.name = "b"}, {.name = "a"}};
  coarse.materialOf = {1, 1};
  const auto found = attributeChanges(fine, coarse, std::array<std::uint32_t, 4>{0, 1, 0, 1});
  ASSERT_EQ(found.size(), 1);
  EXPECT_EQ(found[0].name, "material");
  EXPECT_EQ(found[0].unequal, 2);
  EXPECT_TRUE(std::isinf(found[0].largest));
}

TEST(AttributeChanges, OfNormalsDoNotDependOnTheirLengths) {
  SurfaceMesh fine = strip(), same = strip();
  fine.vertexAttributes = {numbers("normal", AttributeMeaning::normal, 3,
                                   {0, 0, 1, 9, 0, 9, 0, 2, 2, .1, 0, .1, 0, 0, 5, 0, 0, 1})};
  const double h = std::sqrt(0.5);
  same.vertexAttributes = {
      numbers("normal", AttributeMeaning::normal, 3, {0, 0, 1, h, 0, h, 0, h, h, h, 0, h, 0, 0, 1, 0, 0, 1})};
  EXPECT_LT(attributeChanges(fine, same, std::array<std::uint32_t, 4>{0, 1, 2, 3})[0].largest, 1e-9);
}

TEST(AttributeChanges, WhatOneOfThemHasNotIsLeftOut) {
  SurfaceMesh fine = strip();
  fine.vertexAttributes = {numbers("h", AttributeMeaning::other, 1, {.5, 1, 2, 3, 4, 5})};
  EXPECT_TRUE(attributeChanges(fine, halves(), std::array<std::uint32_t, 4>{0, 1, 0, 1}).empty());
}

}  // namespace
}  // namespace arete
