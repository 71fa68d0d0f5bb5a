// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a mesh has comes back from a PLY, or the writer names it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <random>
#include <string>
#include <vector>

#include "io/formats/ply/ply.h"
#include "io/mesh_file_fixture.h"

namespace arete {
namespace {

using namespace test;

using PlyRoundTrip = MeshFileTest;
using Losses = std::vector<std::string>;

constexpr ScalarType kTypes[] = {ScalarType::int8,    ScalarType::uint8,  ScalarType::int16,
                                 ScalarType::uint16,  ScalarType::int32,  ScalarType::uint32,
                                 ScalarType::float32, ScalarType::float64};

/// Random bytes; floats are any bits, NaN included.
Attribute randomAttribute(std::string name, ScalarType type, std::uint8_t components, std::size_t elements,
                          std::mt19937& random) {
  Attribute attribute{.name = std::move(name), .type = type, .components = components};
  attribute.values.resize(elements * attribute.elementBytes());
  for (std::byte& byte : attribute.values) byte = static_cast<std::byte>(random());
  return attribute;
}

Attribute given(std::string name, AttributeMeaning meaning, ScalarType type, std::uint8_t components,
                std::initializer_list<double> numbers) {
  Attribute attribute{.name = std::move(name), .meaning = meaning, .type = type, .components = components};
  const std::vector<double> all = numbers;
  for (std::size_t i = 0; i < all.size(); i += components) attribute.append(std::span(&all[i], components));
  return attribute;
}

Attribute colors(std::string name, ScalarType type, std::uint8_t components,
                 std::initializer_list<double> numbers) {
  Attribute attribute = given(std::move(name), AttributeMeaning::color, type, components, numbers);
  attribute.isNormalized = !isFloat(type);
  attribute.colorSpace = ColorSpace::srgb;
  return attribute;
}

/// Four vertices, of which the last is not used, and two triangles with six wedges.
SurfaceMesh square() {
  SurfaceMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {9, 9, 9}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

class PlyRoundTripOf : public PlyRoundTrip {
 protected:
  SurfaceMesh there(const SurfaceMesh& mesh, const Losses& lost = {}) const {
    const Result<MeshWriteReport> report = writePly(mesh, folder_ / "a.ply");
    if (!report) {
      ADD_FAILURE() << report.error().describe();
      return {};
    }
    EXPECT_EQ(report->lost, lost);
    Result<MeshFile> file = readPly(folder_ / "a.ply");
    if (!file) {
      ADD_FAILURE() << file.error().describe();
      return {};
    }
    EXPECT_TRUE(file->warnings.empty());
    EXPECT_EQ(file->mesh.positions, mesh.positions);
    EXPECT_EQ(file->mesh.triangles, mesh.triangles);
    return std::move(file->mesh);
  }
};

TEST_F(PlyRoundTripOf, KeepsAttributesOfEveryTypeToTheBit) {
  std::mt19937 random(7);
  for (const std::uint8_t components : {1, 2, 4, 255}) {
    SurfaceMesh mesh = square();
    mesh.wedgeCount = 5;
    mesh.wedges = {{0, 1, 2}, {3, 2, 4}};
    for (const ScalarType type : kTypes) {
      const std::string name = "a" + std::to_string(int(type));
      mesh.vertexAttributes.push_back(randomAttribute(name, type, components, 5, random));
      mesh.wedgeAttributes.push_back(randomAttribute(name, type, components, 5, random));
      mesh.triangleAttributes.push_back(randomAttribute(name, type, components, 2, random));
    }
    EXPECT_TRUE(MeshAttributes(there(mesh)) == MeshAttributes(mesh)) << int(components);
  }
}

TEST_F(PlyRoundTripOf, KeepsWhatMeansSomething) {
  using enum AttributeMeaning;
  using enum ScalarType;
  SurfaceMesh mesh = square();
  mesh.vertexAttributes = {
      given("normal", normal, float32, 3, {0, 0, 1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 0, 0, 0}),
      given("tangent", tangent, float64, 4, {1, 0, 0, 1, 1, 0, 0, -1, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 0}),
      given("texcoord", textureCoords, float64, 2, {0, 0.1, 1, 0, 1, 1, 0, 1, 0.5, 0.5}),
      given("texcoord1", textureCoords, float32, 2, {0, 0.5, 1, 0, 1, 1, 0, 1, 0.5, 0.5}),
      colors("color", uint8, 4, {1, 2, 3, 4, 255, 0, 0, 255, 0, 0, 0, 0, 9, 9, 9, 9, 5, 5, 5, 5}),
      colors("color1", uint16, 3, {1, 2, 3, 65535, 0, 0, 255, 0, 0, 0, 0, 9, 9, 9, 9}),
      given("quality", other, float32, 1, {1, 2, 3, 4, 5})};
  mesh.triangleAttributes = {colors("color", float32, 3, {0.5, 0.25, 1, 0, 0, 0}),
                             given("normal", normal, float32, 3, {0, 0, 1, 0, 0, 1}),
                             given("label", other, int32, 1, {-7, 8})};
  mesh.wedgeCount = 5;
  mesh.wedges = {{0, 1, 2}, {3, 2, 4}};
  mesh.wedgeAttributes = {given("texcoord", textureCoords, float32, 2, {0, 0, 1, 0, 1, 1, 0.5, 0, 0, 1}),
                          colors("color", float32, 3, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}),
                          given("normal", normal, float32, 3, {0, 0, 1, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 1, 0})};
  SurfaceMesh back = there(mesh);
  // The order of attributes may change.
  for (auto* list : {&mesh, &back})
    for (auto* attributes : {&list->vertexAttributes, &list->wedgeAttributes, &list->triangleAttributes})
      std::ranges::sort(*attributes, {}, &Attribute::name);
  EXPECT_TRUE(MeshAttributes(back) == MeshAttributes(mesh));
  const std::string bytes = contents(folder_ / "a.ply");
  for (const char* line :
       {"property float nx\n", "property double s\n", "property uchar alpha\n", "property float quality\n",
        "property list uchar float texcoord\n", "property list uchar float color\n",
        "property list uchar float corner_normal\n", "comment attribute vertex tangent 4 tangent\n"})
    EXPECT_NE(bytes.find(line), std::string::npos) << line;
}

TEST_F(PlyRoundTripOf, TellsNamesApartThatAreNoWordsOrTaken) {
  SurfaceMesh mesh = square();
  std::mt19937 random(3);
  for (const char* name : {"x", "x_", "two words", "two_words", " blanks ", "red", "green", "blue", "s",
                           "corner_a", "texcoord", "error", "vertex_indices", "sch\xC3\xB6n", "color"}) {
    mesh.vertexAttributes.push_back(randomAttribute(name, ScalarType::int32, 1, 5, random));
    mesh.triangleAttributes.push_back(randomAttribute(name, ScalarType::int32, 2, 2, random));
  }
  mesh.vertexAttributes.push_back(randomAttribute("normalised", ScalarType::uint16, 2, 5, random));
  mesh.vertexAttributes.back().isNormalized = true;
  mesh.wedgeCount = 5;
  mesh.wedges = {{0, 1, 2}, {3, 2, 4}};
  for (const char* name : {"a b", "a_b", "corner_a_b"})
    mesh.wedgeAttributes.push_back(randomAttribute(name, ScalarType::uint8, 1, 5, random));
  EXPECT_TRUE(MeshAttributes(there(mesh)) == MeshAttributes(mesh));
}

TEST_F(PlyRoundTripOf, TurnsTextureCoordinatesThatCountFromTheTop) {
  SurfaceMesh mesh = square();
  mesh.vertexAttributes = {given("texcoord", AttributeMeaning::textureCoords, ScalarType::uint16, 2,
                                 {0, 0, 65535, 1, 1, 65535, 3, 4, 5, 6})};
  mesh.vertexAttributes[0].isNormalized = true;
  mesh.vertexAttributes[0].isFromTop = true;
  const SurfaceMesh back = there(mesh);
  ASSERT_EQ(back.vertexAttributes.size(), 1u);
  EXPECT_FALSE(back.vertexAttributes[0].isFromTop);
  EXPECT_EQ(back.vertexAttributes[0].type, ScalarType::float32);
  for (std::size_t i = 0; i < 5; ++i) {
    const auto was = mesh.vertexAttributes[0].numbers(i), is = back.vertexAttributes[0].numbers(i);
    EXPECT_EQ(std::round(is[0] * 65535), was[0]);
    EXPECT_EQ(std::round((1 - is[1]) * 65535), was[1]);
  }
}

TEST_F(PlyRoundTripOf, NamesWhatItRoundsAndWhatItHasNoPlaceFor) {
  SurfaceMesh mesh = square();
  mesh.wedgeCount = 3;
  mesh.wedges = {{0, 1, 2}, {0, 2, 1}};
  mesh.wedgeAttributes = {
      given("texcoord", AttributeMeaning::textureCoords, ScalarType::float64, 2, {0.1, 0, 1, 0, 1, 1})};
  mesh.triangles[1] = {0, 2, 1};
  mesh.objects = {"a", "b"};
  mesh.objectOf = {0, 1};
  mesh.groups = {"g"};
  mesh.groupOf = {0, 0};
  mesh.materials = {{.name = "red", .baseColor = {1, 0, 0, 1}}};
  mesh.materialOf = {0, 0};
  const SurfaceMesh back =
      there(mesh, {"objects (\"a\", \"b\")", "groups (\"g\")", "texture coordinates finer than 32-bit floats",
                   "materials (\"red\") but for a picture each"});
  EXPECT_EQ(back.wedgeAttributes[0].numbers(0)[0], double(0.1f));
  // Doubles that are floats lose nothing.
  mesh = square();
  mesh.wedgeCount = 3;
  mesh.wedges = {{0, 1, 2}, {0, 2, 1}};
  mesh.triangles[1] = {0, 2, 1};
  mesh.wedgeAttributes = {
      given("texcoord", AttributeMeaning::textureCoords, ScalarType::float64, 2, {0.5, 0, 1, 0, 1, 1})};
  there(mesh);
}

TEST_F(PlyRoundTripOf, TurnsLinearColorsIntoSrgb) {
  SurfaceMesh mesh = square();
  mesh.vertexAttributes = {
      colors("color", ScalarType::uint16, 4,
             {0, 65535, 13909, 65535, 0, 0, 0, 0, 65535, 65535, 65535, 32896, 0, 0, 0, 0, 0, 0, 0, 0})};
  mesh.vertexAttributes[0].colorSpace = ColorSpace::linear;
  const SurfaceMesh back = there(mesh);
  ASSERT_EQ(back.vertexAttributes.size(), 1u);
  // 0.2134 of the light is 127 / 255 in sRGB, and alpha is no light.
  EXPECT_EQ(back.vertexAttributes[0].numbers(0), (std::vector<double>{0, 255, 127, 255}));
  EXPECT_EQ(back.vertexAttributes[0].numbers(2), (std::vector<double>{255, 255, 255, 128}));
  mesh.vertexAttributes = {
      colors("color", ScalarType::float32, 3, {0.1234567, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0})};
  mesh.vertexAttributes[0].colorSpace = ColorSpace::linear;
  there(mesh, {"colours finer than 8 bits"});
}

TEST_F(PlyRoundTripOf, PlacesThePicturesOfMaterials) {
  fs::create_directories(folder_ / "in/maps");
  fs::create_directories(folder_ / "out");
  put("in/maps/a skin.png", "\x89PNG\r\n\x1A\n");
  SurfaceMesh mesh = square();
  mesh.vertexAttributes = {given("texcoord", AttributeMeaning::textureCoords, ScalarType::float32, 2,
                                 {0, 0, 1, 0, 1, 1, 0, 1, 0, 0})};
  mesh.materials = {{.name = "plain"}, {.name = "a skin"}, {.name = "gone"}};
  mesh.materials[1].textures.push_back({"baseColor", "maps/a skin.png"});
  mesh.materials[2].textures.push_back({"baseColor", "gone.png"});
  mesh.materialOf = {1, MeshAttributes::kNone};
  const auto report = writePly(mesh, folder_ / "out/a.ply", {.pictureFolder = folder_ / "in"});
  ASSERT_TRUE(report) << report.error().describe();
  ASSERT_EQ(report->lost.size(), 2u);
  EXPECT_EQ(report->lost[0], "materials (\"plain\") but for a picture each");
  EXPECT_NE(report->lost[1].find("gone.png"), std::string::npos) << report->lost[1];
  EXPECT_EQ(report->filesBeside.size(), 1u);
  EXPECT_TRUE(fs::exists(folder_ / "out/maps/a skin.png"));
  const Result<MeshFile> file = readPly(folder_ / "out/a.ply");
  ASSERT_TRUE(file) << file.error().describe();
  ASSERT_EQ(file->mesh.materials.size(), 2u);
  EXPECT_TRUE(file->mesh.materials[0] == mesh.materials[1]);
  EXPECT_EQ(file->mesh.materialOf, (std::vector<std::uint32_t>{0, MeshAttributes::kNone}));
  EXPECT_EQ(file->folder, folder_ / "out");
  // One picture for all triangles needs no numbers.
  mesh.materialOf = {1, 1};
  mesh.materials.pop_back();
  ASSERT_TRUE(writePly(mesh, folder_ / "out/b.ply", {.pictureFolder = folder_ / "in"}));
  EXPECT_EQ(contents(folder_ / "out/b.ply").find("texnumber"), std::string::npos);
  EXPECT_EQ(readPly(folder_ / "out/b.ply")->mesh.materialOf, (std::vector<std::uint32_t>{0, 0}));
}

TEST_F(PlyRoundTripOf, WritesATerrainAsBefore) {
  const SurfaceMesh mesh = square();
  const std::vector<float> errors = {1, 2}, qualities(5, 0.5f);
  const std::vector<std::array<std::uint8_t, 3>> shades(5, {1, 2, 3});
  const auto report = writePly(mesh, folder_ / "a.ply",
                               {.crsWkt = "X",
                                .verticalUnit = "metre",
                                .triangleErrors = errors,
                                .vertexQualities = qualities,
                                .vertexColors = shades,
                                .notes = {"n"}});
  ASSERT_TRUE(report);
  EXPECT_TRUE(report->lost.empty() && report->filesBeside.empty());
  const std::string bytes = contents(folder_ / "a.ply");
  const std::string header =
      "ply\nformat binary_little_endian 1.0\ncomment generator arete\ncomment crs X\n"
      "comment vertical_unit metre\ncomment n\nelement vertex 5\nproperty double x\nproperty double y\n"
      "property double z\nproperty float quality\nproperty uchar red\nproperty uchar green\n"
      "property uchar blue\nelement face 2\nproperty list uchar int vertex_indices\nproperty float error\n"
      "end_header\n";
  EXPECT_EQ(bytes.substr(0, header.size()), header);
  EXPECT_EQ(bytes.size(), header.size() + 5 * (24 + 4 + 3) + 2 * (1 + 12 + 4));
}

}  // namespace
}  // namespace arete
