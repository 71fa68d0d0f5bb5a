// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "io/written_glb.h"

namespace arete {
namespace {

using namespace test;

constexpr std::uint32_t kNone = MeshAttributes::kNone;

TEST(GlbWriteSurface, KeepsPositionsAndTheirAxes) {
  SurfaceMesh mesh = square();
  mesh.positions[0].x = -0.0;
  mesh.positions[3].y = 0.1F;
  const Written written(mesh);
  EXPECT_TRUE(written.lost.empty());
  EXPECT_EQ(written.numbersOf("POSITION"),
            (std::vector<double>{0, 0, 1, 1, 0, 2, 0, 1, 3, 1, double{0.1F}, 4}));
  EXPECT_TRUE(std::signbit(written.numbersOf("POSITION")[0]));
  EXPECT_EQ(written.indices(), (std::vector<double>{0, 1, 2, 2, 1, 3}));
  EXPECT_FALSE(written.json["asset"].contains("extras"));
  EXPECT_FALSE(written.primitive()["attributes"].contains("NORMAL")) << "flat, as the standard says";
  EXPECT_FALSE(written.primitive().contains("material"));
  EXPECT_FALSE(written.json["nodes"][0].contains("name")) << "the mesh has no objects";
  EXPECT_FALSE(written.json["nodes"][0].contains("translation"));
}

TEST(GlbWriteSurface, PutsDistantDoublesNearATranslationAndSaysWhatIsRounded) {
  SurfaceMesh mesh = square();
  for (Vec3& p : mesh.positions) p = {p.x + 4'000'000.3, p.y / 3, p.z};
  const Written written(mesh);
  const Json& translation = written.json["nodes"][0]["translation"];
  const std::vector<double> numbers = written.numbersOf("POSITION");
  for (std::size_t v = 0; v < 4; ++v) {
    EXPECT_NEAR(numbers[3 * v] + translation[0].get<double>(), mesh.positions[v].x, 1e-6);
    EXPECT_NEAR(numbers[3 * v + 1], mesh.positions[v].y, 1e-7);
    EXPECT_EQ(numbers[3 * v + 2], mesh.positions[v].z);
  }
  EXPECT_EQ(translation[1], 0) << "near 0, where a translation helps nothing";
  EXPECT_EQ(translation[2], 0);
  EXPECT_TRUE(written.hasLost("coordinates finer than"));
}

TEST(GlbWriteSurface, MakesANodeOfEachObjectAndAPrimitiveOfEachMaterial) {
  SurfaceMesh mesh = square();
  mesh.positions.push_back({9, 9, 9});
  mesh.triangles.push_back({0, 2, 4});
  mesh.triangles.push_back({0, 4, 1});
  mesh.objects = {"near \"wall\"", "empty", "far"};
  mesh.objectOf = {2, 0, 2, 2};
  mesh.materials.resize(2);
  mesh.materials[0].name = "a";
  mesh.materials[1].name = "b";
  mesh.materialOf = {1, kNone, 0, 1};
  const Written written(mesh);
  ASSERT_EQ(written.json["nodes"].size(), 2u);
  EXPECT_EQ(written.json["nodes"][0]["name"], "near \"wall\"");
  EXPECT_EQ(written.json["nodes"][1]["name"], "far");
  EXPECT_FALSE(written.primitive(0, 0).contains("material"));
  EXPECT_EQ(written.indices(0, 0), (std::vector<double>{1, 0, 2})) << "vertices 1, 2 and 3";
  EXPECT_EQ(written.primitive(1, 0)["material"], 1) << "the first triangle has it";
  EXPECT_EQ(written.indices(1, 0), (std::vector<double>{0, 1, 2, 0, 3, 1}));
  EXPECT_EQ(written.indices(1, 1), (std::vector<double>{0, 2, 3}));
  EXPECT_EQ(written.primitive(1, 0)["attributes"], written.primitive(1, 1)["attributes"]) << "shared";
  EXPECT_TRUE(written.hasLost("objects without faces (\"empty\")"));
  EXPECT_TRUE(written.hasLost("vertices that several objects share (2"));
}

TEST(GlbWriteSurface, KeepsVerticesWithoutFacesOfOneObject) {
  SurfaceMesh mesh = square();
  mesh.positions.insert(mesh.positions.begin(), {7, 8, 9});
  for (auto& t : mesh.triangles)
    for (auto& v : t) ++v;
  const Written written(mesh);
  EXPECT_EQ(written.accessorOf("POSITION")["count"], 5);
  EXPECT_TRUE(written.lost.empty());
}

TEST(GlbWriteSurface, ChoosesIndicesThatNeverReachTheLargest) {
  for (const std::uint32_t count : {65535u, 65536u}) {
    SurfaceMesh mesh;
    mesh.positions.resize(count);
    for (std::uint32_t v = 0; v < count; ++v) mesh.positions[v] = {double(v), double(v % 7), 0};
    mesh.triangles = {{0, 1, count - 1}};
    const Written written(mesh);
    const Json& accessor = written.json["accessors"][written.primitive()["indices"].get<std::size_t>()];
    EXPECT_EQ(accessor["componentType"], count == 65535 ? 5123 : 5125);
    EXPECT_EQ(written.indices()[2], count - 1);
  }
}

TEST(GlbWriteSurface, SplitsVerticesWhoseCornersDiffer) {
  SurfaceMesh mesh = square();
  mesh.wedgeCount = 6;
  mesh.wedges = {{0, 1, 2}, {3, 4, 5}};
  mesh.wedgeAttributes = {attribute("texcoord", AttributeMeaning::textureCoords, ScalarType::float32, 2,
                                    {0, 0, 1, 0, 0, 1, 0.5, 0.5, 1, 0, 1, 1})};
  mesh.wedgeAttributes[0].isFromTop = true;
  const Written written(mesh);
  EXPECT_EQ(written.accessorOf("POSITION")["count"], 6) << "wedges with other numbers are other corners";
  EXPECT_EQ(written.numbersOf("TEXCOORD_0"), (std::vector<double>{0, 0, 1, 0, 0, 1, 1, 1, 0.5, 0.5, 1, 0}));
  EXPECT_EQ(written.indices(), (std::vector<double>{0, 1, 2, 4, 5, 3}));
  EXPECT_TRUE(written.hasLost("corners of different values at one vertex (2 vertices are added)"));
}

TEST(GlbWriteSurface, CountsTextureCoordinatesFromTheTop) {
  SurfaceMesh mesh = square();
  const AttributeMeaning uv = AttributeMeaning::textureCoords;
  mesh.vertexAttributes = {
      attribute("texcoord", uv, ScalarType::float32, 2, {0, 0, 0.25, 0.75, -1, 1.5, 1, 1}),
      attribute("texcoord1", uv, ScalarType::uint8, 2, {0, 0, 10, 20, 255, 255, 0, 1}),
      attribute("texcoord2", uv, ScalarType::float32, 2, {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8})};
  mesh.vertexAttributes[1].isNormalized = true;
  mesh.vertexAttributes[2].isFromTop = true;
  const Attribute kept = mesh.vertexAttributes[2];
  const Written written(mesh);
  EXPECT_TRUE(written.lost.empty()) << written.lost[0];
  EXPECT_EQ(written.numbersOf("TEXCOORD_0"), (std::vector<double>{0, 1, 0.25, 0.25, -1, -0.5, 1, 0}));
  EXPECT_EQ(written.numbersOf("TEXCOORD_1"), (std::vector<double>{0, 255, 10, 235, 255, 0, 0, 254}));
  EXPECT_EQ(written.numbersOf("TEXCOORD_2")[0], kept.numbers(0)[0]);
  EXPECT_FALSE(written.json.contains("extensionsUsed"));

  mesh.vertexAttributes = {
      attribute("texcoord3", uv, ScalarType::float64, 3, {0, 0.1, 0, 0, 0, 0, 0, 0, 5, 0, 0, 0})};
  const Written changed(mesh);
  EXPECT_TRUE(changed.hasLost("texture coordinates finer than 32-bit floats"));
  EXPECT_TRUE(changed.hasLost("third texture coordinates"));
  EXPECT_TRUE(changed.hasLost("the numbers of sets"));
  EXPECT_EQ(changed.numbersOf("TEXCOORD_0")[1], double{0.9F}) << "the standard allows no gap before it";
}

TEST(GlbWriteSurface, MakesColorsLinear) {
  SurfaceMesh mesh = square();
  Attribute bytes = attribute("color", AttributeMeaning::color, ScalarType::uint8, 3,
                              {255, 128, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
  bytes.isNormalized = true;
  bytes.colorSpace = ColorSpace::srgb;
  Attribute linear = attribute("color1", AttributeMeaning::color, ScalarType::uint8, 4,
                               {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16});
  linear.isNormalized = true;
  linear.colorSpace = ColorSpace::linear;
  Attribute bright = attribute("color2", AttributeMeaning::color, ScalarType::float32, 3,
                               {0, 0.5, 1, 2, -1, 0, 0, 0, 0, 0, 0, 0});
  bright.colorSpace = ColorSpace::linear;
  mesh.vertexAttributes = {bytes, linear, bright};
  const Written written(mesh);
  EXPECT_EQ(written.accessorOf("COLOR_0")["componentType"], 5123);
  EXPECT_EQ(written.accessorOf("COLOR_0")["normalized"], true);
  EXPECT_EQ(written.numbersOf("COLOR_0")[0], 65535);
  EXPECT_EQ(written.numbersOf("COLOR_0")[1], 14146);
  EXPECT_EQ(written.accessorOf("COLOR_1")["componentType"], 5121);
  EXPECT_EQ(written.numbersOf("COLOR_1")[5], 6);
  EXPECT_EQ(written.numbersOf("COLOR_2"), (std::vector<double>{0, 0.5, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(written.lost, (std::vector<std::string>{"colours below 0 or above 1",
                                                    "colours finer than linear 32-bit floats"}));
}

TEST(GlbWriteSurface, WritesNormalsOfUnitLengthOnly) {
  SurfaceMesh mesh = square();
  const double h = std::sqrt(0.5);
  mesh.vertexAttributes = {attribute("normal", AttributeMeaning::normal, ScalarType::float32, 3,
                                     {0, 0, 1, h, 0, h, 0, 3, 0, 0, 0, 0})};
  const Written written(mesh);
  const std::vector<double> normals = written.numbersOf("NORMAL");
  EXPECT_EQ(normals[3], double{static_cast<float>(h)}) << "to the bit";
  EXPECT_EQ(normals[7], 1);
  EXPECT_NEAR(std::hypot(normals[9], normals[10], normals[11]), 1, 1e-6);
  EXPECT_LT(normals[9], 0) << "as its triangle, (-1, -2, 1)";
  EXPECT_TRUE(written.hasLost("normals of other than unit length (1 are scaled)"));
  EXPECT_TRUE(written.hasLost("normals without a direction (1 are replaced)"));
}

TEST(GlbWriteSurface, KeepsQuantizedNormalsByTheirExtension) {
  SurfaceMesh mesh = square();
  mesh.vertexAttributes = {attribute("normal", AttributeMeaning::normal, ScalarType::int8, 3,
                                     {127, 0, 0, 0, 127, 0, 0, 0, -127, 90, 90, 0})};
  mesh.vertexAttributes[0].isNormalized = true;
  const Written written(mesh);
  EXPECT_EQ(written.accessorOf("NORMAL")["componentType"], 5120);
  EXPECT_EQ(written.numbersOf("NORMAL")[8], -127);
  EXPECT_EQ(written.json["extensionsRequired"], Json({"KHR_mesh_quantization"}));
  EXPECT_EQ(written.json["extensionsUsed"], Json({"KHR_mesh_quantization"}));
}

TEST(GlbWriteSurface, WritesOtherAttributesInTypesOfTheStandard) {
  struct Case {
    ScalarType type;
    std::uint8_t components;
    std::vector<double> numbers;
    int componentType;  // 0: left out
    const char* lost;   // null: nothing
  };
  using enum ScalarType;
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Case> cases = {
      {uint8, 1, {1, 2, 3, 4}, 5121, nullptr},
      {int8, 3, {1, -2, 3, 4, 5, 6, 7, 8, 9, -10, 11, 12}, 5120, nullptr},
      {int16, 1, {-30000, 2, 3, 4}, 5122, nullptr},
      {uint16, 2, {1, 2, 3, 4, 5, 6, 7, 65535}, 5123, nullptr},
      {int32, 1, {0, 65535, 3, 4}, 5123, nullptr},
      {int32, 1, {-5, 32767, 3, 4}, 5122, nullptr},
      {uint32, 1, {1 << 24, 2, 3, 4}, 5126, nullptr},
      {uint32, 1, {16777217, 2, 3, 4}, 0, "\"label\" of vertices"},
      {float32, 1, {0.5, -0.0, 3e38, 1e-40}, 5126, nullptr},
      {float64, 1, {0.5, 2, 3, 4}, 5126, nullptr},
      {float64, 1, {0.1, 2, 3, 4}, 5126, "\"label\" finer than 32-bit floats"},
      {float32, 1, {kNan, 2, 3, 4}, 5126, "the numbers of \"label\" that are not finite (1 become 0)"},
      {float32, 9, std::vector<double>(36, 0.5), 5126, nullptr},
      {uint8, 9, std::vector<double>(36, 1), 0, "\"label\" of vertices"},
      {float32, 5, std::vector<double>(20, 0.5), 0, "\"label\" of vertices"},
  };
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Case& c = cases[i];
    SurfaceMesh mesh = square();
    mesh.vertexAttributes = {attribute("label", AttributeMeaning::other, c.type, c.components, c.numbers)};
    const Written written(mesh);
    EXPECT_EQ(written.lost, c.lost == nullptr ? std::vector<std::string>{} : std::vector<std::string>{c.lost})
        << i;
    ASSERT_EQ(written.primitive()["attributes"].contains("_label"), c.componentType != 0) << i;
    if (c.componentType == 0) continue;
    EXPECT_EQ(written.accessorOf("_label")["componentType"], c.componentType) << i;
    if (c.lost == nullptr) {
      std::vector<double> expected = c.numbers;
      if (c.type == float32)
        for (double& number : expected) number = double{static_cast<float>(number)};
      EXPECT_EQ(written.numbersOf("_label"), expected) << i;
    }
  }
}

TEST(GlbWriteSurface, NamesWhatTheFormatHasNoPlaceFor) {
  SurfaceMesh mesh = square();
  mesh.groups = {"roof"};
  mesh.groupOf = {0, kNone};
  mesh.triangleAttributes = {attribute("flags", AttributeMeaning::other, ScalarType::uint8, 1, {1, 2})};
  mesh.vertexAttributes = {attribute("tangent", AttributeMeaning::tangent, ScalarType::float32, 4,
                                     {1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1})};
  const Written written(mesh);
  EXPECT_EQ(written.lost,
            (std::vector<std::string>{"\"tangent\" of vertices", "\"flags\" of faces", "groups (\"roof\")"}))
      << "the standard has no tangents without normals";
}

TEST(GlbWriteSurface, TurnsNormalsWithTheAxesOfAMap) {
  SurfaceMesh mesh = square();
  for (Vec3& p : mesh.positions) p = {p.x + 500000, p.y + 4e6, p.z};
  mesh.vertexAttributes = {attribute("normal", AttributeMeaning::normal, ScalarType::float32, 3,
                                     {0, 0, 1, 1, 0, 0, 0, 1, 0, 0, -1, 0}),
                           attribute("label", AttributeMeaning::other, ScalarType::uint8, 1, {4, 3, 2, 1})};
  const std::vector<float> errors = {0.5F, 2};
  const Written map(mesh, {.crsWkt = "EPSG:32611", .triangleErrors = errors});
  EXPECT_EQ(map.numbersOf("NORMAL"), (std::vector<double>{0, 1, 0, 1, 0, 0, 0, 0, -1, 0, 0, 1}));
  EXPECT_EQ(map.numbersOf("_label"), (std::vector<double>{4, 3, 2, 1}));
  EXPECT_EQ(map.numbersOf("_ERROR"), (std::vector<double>{0.5, 2, 2, 2}));
  EXPECT_EQ(map.json["asset"]["extras"]["arete"]["crsWkt"], "EPSG:32611");
  EXPECT_TRUE(map.lost.empty());

  for (Vec3& p : mesh.positions) p = {10 + (p.x - 500000) * 1e-5, 50 + (p.y - 4e6) * 1e-5, p.z};
  const Written globe(mesh, {.crsWkt = "EPSG:4326"});
  EXPECT_NE(globe.numbersOf("NORMAL"), map.numbersOf("NORMAL"));
  EXPECT_EQ(globe.lost, (std::vector<std::string>{"normals of its own (they are computed)"}));
}

TEST(GlbWriteSurface, HoldsAMeshWithoutTriangles) {
  SurfaceMesh mesh;
  const Written empty(mesh);
  EXPECT_EQ(empty.json, Json::parse(R"({"asset":{"version":"2.0","generator":"Arete"}})"));
  mesh.positions = {{1, 2, 3}};
  EXPECT_EQ(Written(mesh).lost, (std::vector<std::string>{"vertices without faces"}));
}

TEST(GlbWriteSurface, RefusesPositionsBeyondFloats) {
  const TemporaryFolder folder;
  SurfaceMesh mesh = square();
  mesh.positions[1].x = 1e300;
  const auto report = writeGlb(mesh, folder.file("a.glb"), {.up = MeshUp::y});
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::invalidData);
  EXPECT_EQ(report.error().culprit, folder.file("a.glb"));
}

TEST(GlbWriteSurface, WritesTheSameAsText) {
  const TemporaryFolder folder;
  SurfaceMesh mesh = square();
  mesh.vertexAttributes = {attribute("label", AttributeMeaning::other, ScalarType::uint8, 1, {4, 3, 2, 1})};
  ASSERT_TRUE(writeGltf(mesh, folder.file("a.gltf"), {.up = MeshUp::y}));
  const Json json = Json::parse(bytesOf(folder.file("a.gltf")));
  EXPECT_EQ(json["meshes"], Written(mesh).json["meshes"]);
  EXPECT_EQ(json["accessors"], Written(mesh).json["accessors"]);
  EXPECT_TRUE(
      json["buffers"][0]["uri"].get<std::string>().starts_with("data:application/octet-stream;base64,"));
}

}  // namespace
}  // namespace arete
