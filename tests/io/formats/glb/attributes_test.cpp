// SPDX-License-Identifier: GPL-3.0-or-later
//
// Attributes of vertices and the shapes of primitives.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "io/formats/glb/glb.h"
#include "io/glb_fixture.h"
#include "io/mesh_fixture.h"

namespace arete {
namespace {

using namespace test;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

class GltfAttributes : public ::testing::Test {
 protected:
  MeshFile read(const Assembled& made) const {
    Result<MeshFile> file = readGlb(folder.write("a.glb", made.glb()));
    if (!file) {
      ADD_FAILURE() << file.error().describe();
      return {};
    }
    EXPECT_TRUE(file->mesh.validate());
    return std::move(*file);
  }
  static const Attribute& named(const MeshFile& file, const std::string& name) {
    for (const Attribute& attribute : file.mesh.vertexAttributes)
      if (attribute.name == name) return attribute;
    ADD_FAILURE() << "there is no attribute " << name;
    static const Attribute none;
    return none;
  }
  static std::vector<double> numbersOf(const Attribute& attribute) {
    std::vector<double> numbers;
    for (std::size_t i = 0; i < attribute.elementCount(); ++i)
      for (const double number : attribute.numbers(i)) numbers.push_back(number);
    return numbers;
  }
  static void expectNear(const Attribute& attribute, const std::vector<double>& expected,
                         double tolerance = 1e-7) {
    const std::vector<double> numbers = numbersOf(attribute);
    ASSERT_EQ(numbers.size(), expected.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) EXPECT_NEAR(numbers[i], expected[i], tolerance) << i;
  }

  TemporaryFolder folder;
};

TEST_F(GltfAttributes, KeepTheirTypeAndTheirBits) {
  Assembled made = oneTriangle();
  Json& attributes = made.attributes();
  attributes["NORMAL"] = made.add<float>({0, 0, 1, 0, -0.0F, 1, 0.6F, 0, 0.8F}, "VEC3");
  attributes["TANGENT"] =
      made.add<std::int8_t>({127, 0, 0, 127, 127, 0, 0, -127, 0, 127, 0, 127}, "VEC4", true);
  attributes["TEXCOORD_0"] = made.add<std::uint16_t>({0, 65535, 1, 2, 3, 4}, "VEC2", true);
  attributes["TEXCOORD_1"] = made.add<float>({0.1F, 0.2F, 0.3F, 0.4F, 5, -6}, "VEC2");
  attributes["COLOR_0"] = made.add<std::uint8_t>({255, 1, 0, 128, 2, 3, 4, 255, 9, 9, 9, 9}, "VEC4", true);
  attributes["COLOR_1"] = made.add<std::uint16_t>({1, 2, 3, 4, 5, 6, 7, 8, 65535}, "VEC3", true);
  attributes["_HEAT"] = made.add<float>({1.5F, -2.5F, 1e-30F}, "SCALAR");
  attributes["_ID"] = made.add<std::uint16_t>({7, 65535, 0}, "SCALAR");
  attributes["_Frame"] = made.add<std::int16_t>({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, -12}, "MAT2");
  const MeshFile file = read(made);
  EXPECT_TRUE(file.warnings.empty()) << joined(file.warnings);
  EXPECT_EQ(file.mesh.vertexAttributes.size(), 9u);
  const auto expect = [&](const char* name, AttributeMeaning meaning, ScalarType type, int components,
                          bool isNormalized, const std::vector<double>& numbers) {
    const Attribute& a = named(file, name);
    EXPECT_EQ(a.meaning, meaning) << name;
    EXPECT_EQ(a.type, type) << name;
    EXPECT_EQ(a.components, components) << name;
    EXPECT_EQ(a.isNormalized, isNormalized) << name;
    EXPECT_EQ(numbersOf(a), numbers) << name;
    EXPECT_EQ(a.isFromTop, meaning == AttributeMeaning::textureCoords) << name;
    EXPECT_EQ(a.colorSpace, meaning == AttributeMeaning::color ? ColorSpace::linear : ColorSpace::none);
  };
  using enum AttributeMeaning;
  expect("normal", normal, ScalarType::float32, 3, false,
         {0, 0, 1, 0, -0.0, 1, double{0.6F}, 0, double{0.8F}});
  EXPECT_TRUE(std::signbit(named(file, "normal").numbers(1)[1]));
  expect("tangent", tangent, ScalarType::int8, 4, true, {127, 0, 0, 127, 127, 0, 0, -127, 0, 127, 0, 127});
  expect("texcoord", textureCoords, ScalarType::uint16, 2, true, {0, 65535, 1, 2, 3, 4});
  expect("texcoord1", textureCoords, ScalarType::float32, 2, false,
         {double{0.1F}, double{0.2F}, double{0.3F}, double{0.4F}, 5, -6});
  expect("color", color, ScalarType::uint8, 4, true, {255, 1, 0, 128, 2, 3, 4, 255, 9, 9, 9, 9});
  expect("color1", color, ScalarType::uint16, 3, true, {1, 2, 3, 4, 5, 6, 7, 8, 65535});
  expect("_HEAT", other, ScalarType::float32, 1, false, {1.5, -2.5, double{1e-30F}});
  expect("_ID", other, ScalarType::uint16, 1, false, {7, 65535, 0});
  expect("_Frame", other, ScalarType::int16, 4, false, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, -12});
}

TEST_F(GltfAttributes, OfPositionsMayBeQuantized) {
  Assembled made;
  made.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  made.json["nodes"][0]["scale"] = {2, 2, 2};
  made.json["nodes"][0]["translation"] = {1, 0, 0};
  made.attributes()["POSITION"] =
      made.add<std::int16_t>({32767, -32768, 0, 0, 16384, 1, -1, 0, 0}, "VEC3", true);
  const std::vector<Vec3> normalized = read(made).mesh.positions;
  EXPECT_EQ(normalized[0], (Vec3{3, -2, 0})) << "the least number is -1, no less";
  EXPECT_EQ(normalized[1], (Vec3{1, 2 * (16384 / 32767.0), 2 * (1 / 32767.0)}));
  // Unsigned bytes that stand for themselves, four bytes apart.
  made.attributes()["POSITION"] = made.add<std::uint8_t>({255, 0, 7, 1, 2, 3, 4, 5, 6}, "VEC3");
  Json& accessor = made.json["accessors"][1];
  accessor["bufferView"] = made.view(packed<std::uint8_t>({255, 0, 7, 99, 1, 2, 3, 99, 4, 5, 6, 99}), 4);
  EXPECT_EQ(read(made).mesh.positions, (std::vector<Vec3>{{511, 0, 14}, {3, 4, 6}, {9, 10, 12}}));
}

TEST_F(GltfAttributes, OfDirectionsTurnWithTheirNodes) {
  Assembled made = oneTriangle();
  const float r = std::sqrt(0.5F);
  made.attributes()["NORMAL"] = made.add<float>({0, 0, 1, r, 0, r, 1, 0, 0}, "VEC3");
  made.attributes()["TANGENT"] = made.add<float>({1, 0, 0, 1, r, 0, -r, 1, 0, 1, 0, -1}, "VEC4");
  // Moved and enlarged: the same bits.
  Json& node = made.json["nodes"][0];
  node["translation"] = {1, 2, 3};
  node["scale"] = {5, 5, 5};
  MeshFile file = read(made);
  EXPECT_EQ(numbersOf(named(file, "normal")),
            (std::vector<double>{0, 0, 1, double{r}, 0, double{r}, 1, 0, 0}));
  // A quarter round z, as a matrix: x becomes y; no rounding.
  node = {{"mesh", 0}, {"matrix", {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}};
  file = read(made);
  EXPECT_EQ(numbersOf(named(file, "normal")),
            (std::vector<double>{0, 0, 1, 0, double{r}, double{r}, 0, 1, 0}));
  EXPECT_EQ(numbersOf(named(file, "tangent")),
            (std::vector<double>{0, 1, 0, 1, 0, double{r}, double{-r}, 1, -1, 0, 0, -1}));
  // Stretched along x: tangents lean to it, normals from it.
  node = {{"mesh", 0}, {"scale", {3, 1, 1}}};
  file = read(made);
  const double a = 1 / std::sqrt(10.0);
  expectNear(named(file, "normal"), {0, 0, 1, a, 0, 3 * a, 1, 0, 0});
  expectNear(named(file, "tangent"), {1, 0, 0, 1, 3 * a, 0, -a, 1, 0, 1, 0, -1});
  // Mirrored at x = 0: triangles turn over, normals do not, the sign of the third direction does.
  node = {{"mesh", 0}, {"scale", {-1, 1, 1}}};
  file = read(made);
  EXPECT_EQ(file.mesh.triangles, (Triangles{{0, 2, 1}}));
  EXPECT_EQ(numbersOf(named(file, "normal")),
            (std::vector<double>{0, 0, 1, double{-r}, 0, double{r}, -1, 0, 0}));
  EXPECT_EQ(numbersOf(named(file, "tangent")),
            (std::vector<double>{-1, 0, 0, -1, double{-r}, 0, double{-r}, -1, 0, 1, 0, 1}));
  // Flattened: the normals of the plane.
  node = {{"mesh", 0}, {"scale", {1, 1, 0}}};
  expectNear(named(read(made), "normal"), {0, 0, 1, 0, 0, 1, 0, 0, 0});
}

TEST_F(GltfAttributes, OfSeveralPrimitivesBecomeOne) {
  Assembled made;
  made.primitive() = {{"attributes", Json::object()}};
  for (int p = 0; p < 3; ++p) {
    if (p > 0) made.json["meshes"][0]["primitives"].push_back({{"attributes", Json::object()}});
    made.attributes(std::size_t(p))["POSITION"] = made.add<float>({0, 0, float(p), 1, 0, 0, 0, 1, 0}, "VEC3");
  }
  made.attributes(0)["COLOR_0"] = made.add<std::uint8_t>({255, 0, 1, 2, 3, 4, 5, 6, 7}, "VEC3", true);
  made.attributes(1)["COLOR_0"] =
      made.add<std::uint16_t>({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 65535}, "VEC4", true);
  made.attributes(1)["_ID"] = made.add<std::uint8_t>({1, 2, 255}, "SCALAR");
  made.attributes(2)["_ID"] = made.add<std::int16_t>({-1, -2, -300}, "SCALAR");
  made.attributes(2)["_T"] = made.add<float>({1, 2, 3}, "SCALAR");
  MeshFile file = read(made);
  const Attribute& color = named(file, "color");
  EXPECT_EQ(color.type, ScalarType::uint16);
  EXPECT_TRUE(color.isNormalized);
  EXPECT_EQ(
      numbersOf(color),
      (std::vector<double>{
          65535, 0,     257,   65535, 514,   771,   1028,  65535, 1285,  1542,  1799,  65535,  // v * 257
          1,     2,     3,     4,     5,     6,     7,     8,     9,     10,    11,    65535,  //
          65535, 65535, 65535, 65535, 65535, 65535, 65535, 65535, 65535, 65535, 65535, 65535}));
  EXPECT_EQ(named(file, "_ID").type, ScalarType::int16);
  EXPECT_EQ(numbersOf(named(file, "_ID")), (std::vector<double>{0, 0, 0, 1, 2, 255, -1, -2, -300}));
  EXPECT_EQ(numbersOf(named(file, "_T")), (std::vector<double>{0, 0, 0, 0, 0, 0, 1, 2, 3}));
  const std::string warnings = joined(file.warnings);
  EXPECT_TRUE(contains(warnings, "3 of 9 vertices do not have the attribute \"COLOR_0\", which is 1 there"))
      << warnings;
  EXPECT_TRUE(contains(warnings, "the attribute \"COLOR_0\" has several types")) << warnings;
  EXPECT_TRUE(contains(warnings, "6 of 9 vertices do not have the attribute \"_T\", which is 0 there"))
      << warnings;
  // Floats and fractions: floats.
  made.attributes(2)["COLOR_0"] = made.add<float>({0.5F, 0, 0, 0, 0.25F, 0, 0, 0, 1}, "VEC3");
  file = read(made);
  EXPECT_EQ(named(file, "color").type, ScalarType::float32);
  EXPECT_FALSE(named(file, "color").isNormalized);
  EXPECT_EQ(named(file, "color").numbers(0)[2], double{1.0F / 255});
  EXPECT_EQ(named(file, "color").numbers(6), (std::vector<double>{0.5, 0, 0, 1}));
}

TEST_F(GltfAttributes, OfColorsInWholeNumbersAreFractionsEvenIfTheFileForgetsIt) {
  Assembled made = oneTriangle();
  made.attributes()["COLOR_0"] = made.add<std::uint8_t>({255, 0, 1, 2, 3, 4, 5, 6, 7}, "VEC3");
  const MeshFile file = read(made);
  EXPECT_TRUE(named(file, "color").isNormalized);
  EXPECT_EQ(numbersOf(named(file, "color")), (std::vector<double>{255, 0, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_TRUE(contains(joined(file.warnings), "\"COLOR_0\" is of whole numbers"));
}

TEST_F(GltfAttributes, ThatDoNotFitAreLeftOutByName) {
  Assembled made = oneTriangle();
  made.attributes()["NORMAL"] = made.add<float>({0, 0, 1, 0, 0, 1}, "VEC3");
  made.attributes()["TEXCOORD_0"] = made.add<float>({0, 0, 1, 0, 0, 1, 0, 0, 0}, "VEC3");
  made.attributes()["_BROKEN"] = 99;
  // Names of ours that a file uses as its own do not become ours.
  made.attributes()["normal"] = made.add<float>({1, 2, 3}, "SCALAR");
  made.attributes()["COLOR_00"] = made.add<float>({4, 5, 6}, "SCALAR");
  const MeshFile file = read(made);
  const std::string warnings = joined(file.warnings);
  EXPECT_TRUE(contains(warnings, "\"NORMAL\" is left out: it is of 2 vertices, of 3")) << warnings;
  EXPECT_TRUE(contains(warnings, "\"TEXCOORD_0\" is left out: it has 3 components")) << warnings;
  EXPECT_TRUE(contains(warnings, "\"_BROKEN\" is left out: names element 99")) << warnings;
  EXPECT_EQ(numbersOf(named(file, "_normal")), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(named(file, "_normal").meaning, AttributeMeaning::other);
  EXPECT_EQ(file.mesh.vertexAttributes.size(), 1u) << "COLOR_00 has one component";
}

TEST_F(GltfAttributes, AreMovedByMorphTargetsToo) {
  Assembled made = oneTriangle();
  made.attributes()["NORMAL"] = made.add<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  made.attributes()["TANGENT"] = made.add<float>({1, 0, 0, -1, 1, 0, 0, 1, 1, 0, 0, 1}, "VEC4");
  made.attributes()["COLOR_0"] = made.add<float>({1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3");
  // Two sparse moves, and one of colors beyond 1.
  const std::size_t indices = made.view(packed<std::uint16_t>({1})),
                    values = made.view(packed<float>({0, 8, -2}));
  made.json["accessors"].push_back({{"componentType", 5126},
                                    {"count", 3},
                                    {"type", "VEC3"},
                                    {"sparse",
                                     {{"count", 1},
                                      {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                                      {"values", {{"bufferView", values}}}}}});
  const std::size_t moves = made.json["accessors"].size() - 1;
  made.primitive()["targets"] = {
      {{"POSITION", moves}, {"NORMAL", moves}, {"TANGENT", moves}, {"COLOR_0", moves}}};
  made.json["meshes"][0]["weights"] = {0.5};
  const MeshFile file = read(made);
  EXPECT_EQ(file.mesh.positions, (std::vector<Vec3>{{0, 0, 0}, {1, 4, -1}, {0, 1, 0}}));
  expectNear(named(file, "normal"), {0, 0, 1, 0, 1, 0, 0, 0, 1});
  expectNear(named(file, "color"), {1, 0, 0, 0, 1, 0, 0, 0, 1});
  const double n = std::sqrt(18.0);
  expectNear(named(file, "tangent"), {1, 0, 0, -1, 1 / n, 4 / n, -1 / n, 1, 1, 0, 0, 1});
}

TEST_F(GltfAttributes, StayWithTheirVerticesWhereAStripOrAFanNamesThem) {
  Assembled made;
  made.attributes()["POSITION"] = made.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0}, "VEC3");
  made.attributes()["_ID"] = made.add<std::uint8_t>({10, 11, 12, 13, 14}, "SCALAR");
  // Section 3.7.2.1: every second triangle of a strip turns; a degenerate one stays.
  made.primitive()["mode"] = 5;
  EXPECT_EQ(read(made).mesh.triangles, (Triangles{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
  made.primitive()["indices"] = made.add<std::uint8_t>({0, 1, 2, 2, 3, 4}, "SCALAR");
  EXPECT_EQ(read(made).mesh.triangles, (Triangles{{0, 1, 2}, {1, 2, 2}, {2, 2, 3}, {2, 4, 3}}));
  made.primitive()["mode"] = 6;
  made.primitive()["indices"] = made.add<std::uint16_t>({4, 0, 1, 3}, "SCALAR");
  MeshFile file = read(made);
  // p = {v(i+1), v(i+2), v(0)}; vertex 2 is not used.
  EXPECT_EQ(file.mesh.triangles, (Triangles{{0, 1, 3}, {1, 2, 3}}));
  EXPECT_EQ(numbersOf(named(file, "_ID")), (std::vector<double>{10, 11, 13, 14}));
  // A node that mirrors turns those of strips and fans too.
  made.json["nodes"][0]["scale"] = {1, -1, 1};
  EXPECT_EQ(read(made).mesh.triangles, (Triangles{{0, 3, 1}, {1, 3, 2}}));
  // Too few corners for a triangle.
  for (const int mode : {5, 6})
    for (const int count : {1, 2}) {
      Assembled few = oneTriangle();
      few.primitive()["mode"] = mode;
      few.json["accessors"][0]["count"] = count;
      EXPECT_TRUE(contains(refusal(folder.write("a.glb", few.glb())).message, "no triangle"))
          << mode << count;
    }
}

TEST_F(GltfAttributes, HaveNoIndexThatRestartsAStrip) {
  for (const int mode : {4, 5}) {
    Assembled made;
    made.attributes()["POSITION"] = made.add(std::vector<float>(3 * 300, 1), "VEC3");
    made.primitive()["mode"] = mode;
    made.primitive()["indices"] = made.add<std::uint8_t>({0, 1, 255}, "SCALAR");
    const Error error = refusal(folder.write("a.glb", made.glb()));
    EXPECT_EQ(error.code, ErrorCode::corrupt);
    EXPECT_TRUE(contains(error.message, "corner 2 names vertex 255, which no index may")) << error.message;
  }
}

TEST_F(GltfAttributes, AreSharedOnlyByPrimitivesThatShareThemAll) {
  Assembled made = oneTriangle();
  made.attributes()["_A"] = made.add<float>({1, 2, 3}, "SCALAR");
  const std::size_t other = made.add<float>({4, 5, 6}, "SCALAR");
  made.json["meshes"][0]["primitives"].push_back(made.primitive());
  EXPECT_EQ(read(made).mesh.positions.size(), 3u);
  made.attributes(1)["_A"] = other;
  const MeshFile file = read(made);
  EXPECT_EQ(numbersOf(named(file, "_A")), (std::vector<double>{1, 2, 3, 4, 5, 6}));
  // One mesh twice at one place is two.
  made.json["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}}};
  made.json["scenes"][0]["nodes"] = {0, 1};
  EXPECT_EQ(read(made).mesh.positions.size(), 12u);
}

TEST_F(GltfAttributes, OfATerrainOfOursAreNotItsComputedNormals) {
  const std::vector<float> errors = {0.5F, 0.25F};
  ASSERT_TRUE(writeMesh(kTwo, folder.file("a.glb"), {.crsWkt = "EPSG:32611", .triangleErrors = errors}));
  const Result<MeshFile> file = readGlb(folder.file("a.glb"));
  ASSERT_TRUE(file) << file.error().describe();
  EXPECT_EQ(MeshAttributes(file->mesh), MeshAttributes{});
  EXPECT_TRUE(file->warnings.empty()) << joined(file->warnings);
}

}  // namespace
}  // namespace arete
