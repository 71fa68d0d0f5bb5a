// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/surface/attribute_tolerances.h"

#include <gtest/gtest.h>

#include "surface/builder/build.h"
#include "surface/shapes.h"

namespace arete {
namespace {

/// A sheet with colours of vertices, groups, labels and a measured number of faces.
SurfaceModel sheetOfAll() {
  SurfaceMesh mesh(shapes::sheet(6, 4));
  Attribute color{.name = "color",
                  .meaning = AttributeMeaning::color,
                  .type = ScalarType::uint8,
                  .components = 3,
                  .isNormalized = true};
  for (const Vec3& p : mesh.positions) color.append(std::array{40 * p.x, 60 * p.y, 0.0});
  Attribute label{.name = "label", .type = ScalarType::int32}, heat{.name = "heat"};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    label.append(std::array{t < 20 ? 1.0 : 2.0});
    heat.append(std::array{0.37 * double(t)});
    mesh.groupOf.push_back(t % 2);
  }
  mesh.groups = {"a", "b"};
  mesh.vertexAttributes = {color};
  mesh.triangleAttributes = {label, heat};
  return *buildSurface(mesh, {.boundsAttributes = true});
}

TEST(AttributeTolerances, AreOfWhatIsBoundedOrAPart) {
  const SurfaceModel model = sheetOfAll();
  const auto read = [&](std::vector<AttributeNumber> asked) { return attributeTolerances(model, asked); };
  const auto colors = read({{"color", 8, ""}});
  ASSERT_TRUE(colors) << colors.error().describe();
  ASSERT_EQ(colors->size(), 1u);
  EXPECT_EQ(colors->front().most, 8);
  const auto labels = read({{"label", 0, ""}});
  ASSERT_TRUE(labels) << labels.error().describe();
  EXPECT_TRUE(labels->empty());
}

TEST(AttributeTolerances, OfWhatCutsDoNotKeepAreRefusedByName) {
  const SurfaceModel model = sheetOfAll();
  for (const auto& [asked, sentence] : {std::pair{AttributeNumber{"group", 0, ""}, "groups"},
                                        {AttributeNumber{"heat", 1, ""}, "averaged"},
                                        {AttributeNumber{"uv", 1, ""}, "is not an attribute"},
                                        {AttributeNumber{"color", 2, "px"}, "not counted in pixels"}}) {
    const auto refused = attributeTolerances(model, std::vector{asked});
    ASSERT_FALSE(refused) << asked.name;
    EXPECT_EQ(refused.error().code, ErrorCode::usage);
    EXPECT_EQ(refused.error().culprit, "attributeErrors " + asked.name);
    EXPECT_NE(refused.error().message.find(sentence), std::string::npos) << refused.error().message;
  }
}

TEST(AttributeTolerances, OfAModelWithoutBoundsSayHowItGetsThem) {
  SurfaceMesh mesh(shapes::sheet(3, 3));
  Attribute heat{.name = "heat"};
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) heat.append(std::array{0.5 * double(v)});
  mesh.vertexAttributes = {heat};
  const auto model = buildSurface(mesh);
  ASSERT_TRUE(model);
  const auto refused = attributeTolerances(*model, std::vector{AttributeNumber{"heat", 1, ""}});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("boundsAttributes"), std::string::npos);
}

// One of vertices and one of faces of the same name: that of the faces, which nothing bounds, decides.
TEST(AttributeTolerances, OfVerticesAndFacesOfOneNameNeedBoth) {
  SurfaceMesh mesh(shapes::sheet(3, 3));
  Attribute heat{.name = "heat"};
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) heat.append(std::array{0.5 * double(v)});
  mesh.vertexAttributes = {heat};
  heat.values.clear();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) heat.append(std::array{0.37 * double(t)});
  mesh.triangleAttributes = {heat};
  const auto model = buildSurface(mesh, {.boundsAttributes = true});
  ASSERT_TRUE(model) << model.error().describe();
  EXPECT_FALSE(attributeTolerances(*model, std::vector{AttributeNumber{"heat", 1, ""}}));
}

}  // namespace
}  // namespace arete
