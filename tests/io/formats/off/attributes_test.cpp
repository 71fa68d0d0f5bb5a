// SPDX-License-Identifier: GPL-3.0-or-later
//
// Colors, normals and texture coordinates of an OFF, as Geomview describes them and as programs write them.
#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>
#include <string>
#include <vector>

#include "io/formats/off/off.h"
#include "io/mesh_file_fixture.h"

namespace arete {
namespace {

using namespace test;

using Numbers = std::vector<double>;

Numbers numbersOf(const Attribute& attribute) {
  Numbers numbers;
  for (std::size_t i = 0; i < attribute.elementCount(); ++i)
    for (const double number : attribute.numbers(i)) numbers.push_back(number);
  return numbers;
}

Attribute given(std::string name, AttributeMeaning meaning, ScalarType type, std::uint8_t components,
                std::initializer_list<double> numbers) {
  Attribute attribute{.name = std::move(name), .meaning = meaning, .type = type, .components = components};
  if (meaning == AttributeMeaning::color) {
    attribute.isNormalized = !isFloat(type);
    attribute.colorSpace = ColorSpace::srgb;
  }
  const std::vector<double> all = numbers;
  for (std::size_t i = 0; i < all.size(); i += components) attribute.append(std::span(&all[i], components));
  return attribute;
}

class OffAttributes : public MeshFileTest {
 protected:
  MeshFile read(const std::string& text, std::size_t warnings = 0) const {
    Result<MeshFile> file = readOff(put("a.off", text));
    if (!file) {
      ADD_FAILURE() << text << file.error().describe();
      return {};
    }
    EXPECT_TRUE(file->mesh.validate());
    EXPECT_EQ(file->warnings.size(), warnings)
        << text << (warnings < file->warnings.size() ? file->warnings[0].sentence : "");
    return std::move(*file);
  }
};

TEST_F(OffAttributes, OfVerticesAreInGeomviewsOrder) {
  const MeshFile file = read(
      "STCNOFF\n3 1 0\n0 0 0 0 0 1 0.1 0.25 1 1 0 0.3\n1 0 0 0 1 0 0.2 0 0 0.5 1 0\n0 1 0 1 0 0 0 0 0 1 0 1\n"
      "3 0 1 2\n");
  const auto& vertices = file.mesh.vertexAttributes;
  ASSERT_EQ(vertices.size(), 3u);
  EXPECT_EQ(vertices[0].name, "normal");
  EXPECT_EQ(numbersOf(vertices[0]), (Numbers{0, 0, 1, 0, 1, 0, 1, 0, 0}));
  EXPECT_EQ(vertices[1].name, "color");
  EXPECT_EQ(vertices[1].type, ScalarType::float32);
  EXPECT_EQ(vertices[1].colorSpace, ColorSpace::srgb);
  EXPECT_EQ(numbersOf(vertices[1]), (Numbers{double(0.1f), 0.25, 1, 1, double(0.2f), 0, 0, 0.5, 0, 0, 0, 1}));
  EXPECT_EQ(vertices[2].name, "texcoord");
  EXPECT_EQ(vertices[2].numbers(0)[1], double(0.3f));
}

TEST_F(OffAttributes, TellsMeshLabsOrderByTheLengthOfNormals) {
  // MeshLab writes the colour before the normal and says NCOFF; its own reader turns a white sphere red.
  const MeshFile meshLab = read(
      "NCOFF\n3 1 0\n0 0 0 255 254 253 255 0 0.6 0.8\n1 0 0 1 0 0 255 0 1 0\n0 1 0 9 8 7 255 1 0 0\n3 0 1 "
      "2\n");
  ASSERT_EQ(meshLab.mesh.vertexAttributes.size(), 2u);
  EXPECT_EQ(meshLab.mesh.vertexAttributes[0].numbers(0), (Numbers{0, double(0.6f), double(0.8f)}));
  EXPECT_EQ(meshLab.mesh.vertexAttributes[1].type, ScalarType::uint8);
  EXPECT_EQ(numbersOf(meshLab.mesh.vertexAttributes[1]),
            (Numbers{255, 254, 253, 255, 1, 0, 0, 255, 9, 8, 7, 255}));
  const MeshFile geomview = read(
      "NCOFF\n3 1 0\n0 0 0 0 0.6 0.8 255 254 253 255\n1 0 0 0 1 0 1 0 0 255\n0 1 0 1 0 0 9 8 7 255\n3 0 1 "
      "2\n");
  EXPECT_TRUE(geomview.mesh == meshLab.mesh);
}

TEST_F(OffAttributes, HaveColorsOfBytesOrFloats) {
  struct Case {
    std::string a, b, c;
    ScalarType type;
    Numbers numbers;
  };
  for (const Case& one : {
           Case{"255 0 1", "2 3 4", "0 0 0", ScalarType::uint8, {255, 0, 1, 2, 3, 4, 0, 0, 0}},
           // floats that a program wrote without a point, in all lines or in some
           Case{"1 0 0", "0 1 0", "0 0 1", ScalarType::float32, {1, 0, 0, 0, 1, 0, 0, 0, 1}},
           Case{"1 0 0", "0.5 1 0", "0 0 1", ScalarType::float32, {1, 0, 0, 0.5, 1, 0, 0, 0, 1}},
           Case{"255.0 0.0 1.0", "2.0 3.0 4.0", "0 0 0", ScalarType::uint8, {255, 0, 1, 2, 3, 4, 0, 0, 0}},
           // digits of a double
           Case{"0.1234567890123 0 0",
                "0 0 0",
                "0 0 1",
                ScalarType::float64,
                {0.1234567890123, 0, 0, 0, 0, 0, 0, 0, 1}},
           // an alpha in one line
           Case{"255 0 1", "2 3 4 5", "0 0 0", ScalarType::uint8, {255, 0, 1, 255, 2, 3, 4, 5, 0, 0, 0, 255}},
       }) {
    const MeshFile vertices =
        read("COFF\n3 1 0\n0 0 0 " + one.a + "\n1 0 0 " + one.b + "\n0 1 0 " + one.c + "\n3 0 1 2\n");
    ASSERT_EQ(vertices.mesh.vertexAttributes.size(), 1u);
    EXPECT_EQ(vertices.mesh.vertexAttributes[0].type, one.type) << one.a;
    EXPECT_EQ(numbersOf(vertices.mesh.vertexAttributes[0]), one.numbers) << one.a;
    const MeshFile faces = read("OFF\n3 3 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 " + one.a + "\n3 0 1 2 " + one.b +
                                "\n3 0 2 1 " + one.c + "\n");
    ASSERT_EQ(faces.mesh.triangleAttributes.size(), 1u);
    EXPECT_EQ(faces.mesh.triangleAttributes[0].type, one.type) << one.a;
    EXPECT_EQ(numbersOf(faces.mesh.triangleAttributes[0]), one.numbers) << one.a;
  }
}

TEST_F(OffAttributes, OfFacesCountFacesAndNotTriangles) {
  const MeshFile file =
      read("OFF\n4 4 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3 255 0 0\n2 0 1 9 9 9\n3 0 1 2\n3 2 1 0 3\n", 3);
  EXPECT_EQ(file.mesh.faceOf, (std::vector<std::uint32_t>{0, 0, 2, 3}));
  ASSERT_EQ(file.mesh.triangleAttributes.size(), 1u);
  // Faces without a colour are white; the one with an index is named.
  EXPECT_EQ(numbersOf(file.mesh.triangleAttributes[0]),
            (Numbers{255, 0, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255}));
}

TEST_F(OffAttributes, ThatTheKeywordDoesNotStateAreColorsIfTheyCanBe) {
  const std::string face = "3 0 1 2\n";
  const MeshFile colors = read("OFF\n3 1 0\n0 0 0 255 0 0 255\n1 0 0 1 2 3 4\n0 1 0 0 0 0 0\n" + face, 1);
  ASSERT_EQ(colors.mesh.vertexAttributes.size(), 1u);
  EXPECT_EQ(colors.mesh.vertexAttributes[0].type, ScalarType::uint8);
  EXPECT_NE(colors.warnings[0].sentence.find("colours"), std::string::npos);
  for (const std::string more : {"0.5 0.5 1", "300 0 0", "1 2", "1 2 3 4 5", "7"}) {
    const MeshFile other =
        read("OFF\n3 1 0\n0 0 0 " + more + "\n1 0 0 " + more + "\n0 1 0 " + more + "\n" + face, 1);
    EXPECT_TRUE(other.mesh.vertexAttributes.empty()) << more;
  }
  // Only some have them.
  EXPECT_TRUE(read("OFF\n3 1 0\n0 0 0 255 0 0\n1 0 0\n0 1 0\n" + face, 1).mesh.vertexAttributes.empty());
  // Less than the keyword states: in all vertices, or in some.
  EXPECT_TRUE(read("NOFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n" + face, 1).mesh.vertexAttributes.empty());
  const MeshFile some = read("CNOFF\n3 1 0\n0 0 0 0 0 1 9 8 7\n1 0 0\n0 1 0 0 0 1 6 5 4 3\n" + face, 1);
  ASSERT_EQ(some.mesh.vertexAttributes.size(), 2u);
  EXPECT_EQ(numbersOf(some.mesh.vertexAttributes[0]), (Numbers{0, 0, 1, 0, 0, 0, 0, 0, 1}));
  EXPECT_EQ(numbersOf(some.mesh.vertexAttributes[1]),
            (Numbers{9, 8, 7, 255, 255, 255, 255, 255, 6, 5, 4, 3}));
}

TEST_F(OffAttributes, ComeBackAsTheyWere) {
  using enum AttributeMeaning;
  using enum ScalarType;
  const Attribute normals = given("normal", normal, float32, 3, {0, 0, 1, 0.1, 1e-30, 1, 0, 1, 0}),
                  doubles = given("normal", normal, float64, 3, {0, 0, 1.0 / 3, 0, 1e-300, 1, 0, 1, 0}),
                  coords = given("texcoord", textureCoords, float32, 2, {0, 0.1, 1, 0, -0.5, 7}),
                  bytes = given("color", color, uint8, 3, {0, 1, 1, 0, 0, 0, 1, 1, 1}),
                  floats = given("color", color, float32, 4, {0, 1, 1, 0, 0, 0, 1, 1, 1, 1, 1, 1}),
                  shades = given("color", color, float64, 3, {0.1, 1.0 / 3, 1, 0, 0, 0, 1, 1, 1e-20});
  for (const auto& attributes : std::vector<std::vector<Attribute>>{{normals},
                                                                    {doubles},
                                                                    {bytes},
                                                                    {floats},
                                                                    {coords},
                                                                    {normals, bytes},
                                                                    {doubles, floats, coords},
                                                                    {shades}}) {
    SurfaceMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0.1}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}};
    mesh.vertexAttributes = attributes;
    for (const Attribute& attribute : attributes)
      if (attribute.meaning == color) mesh.triangleAttributes = {attribute};
    const Result<MeshWriteReport> report = writeOff(mesh, folder_ / "a.off");
    ASSERT_TRUE(report) << report.error().describe();
    EXPECT_TRUE(report->lost.empty());
    const Result<MeshFile> file = readOff(folder_ / "a.off");
    ASSERT_TRUE(file) << file.error().describe();
    EXPECT_TRUE(file->mesh == mesh) << contents(folder_ / "a.off");
    EXPECT_TRUE(file->warnings.empty());
  }
}

TEST_F(OffAttributes, ThatItHasNoPlaceForAreNamed) {
  SurfaceMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  mesh.vertexAttributes = {given("quality", AttributeMeaning::other, ScalarType::float32, 1, {1, 2, 3})};
  mesh.wedges = {{0, 1, 2}};
  mesh.wedgeCount = 3;
  mesh.wedgeAttributes = {
      given("texcoord", AttributeMeaning::textureCoords, ScalarType::float32, 2, {0, 0, 1, 0, 0, 1})};
  mesh.triangleAttributes = {given("label", AttributeMeaning::other, ScalarType::int32, 1, {1})};
  const Result<MeshWriteReport> report = writeOff(mesh, folder_ / "a.off");
  ASSERT_TRUE(report);
  EXPECT_EQ(report->lost, (std::vector<std::string>{"\"quality\" of vertices", "\"texcoord\" of corners",
                                                    "\"label\" of faces"}));
  EXPECT_TRUE(contents(folder_ / "a.off").starts_with("OFF\n"));
}

}  // namespace
}  // namespace arete
