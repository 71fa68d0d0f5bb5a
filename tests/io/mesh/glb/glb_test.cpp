// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mesh/glb/glb.h"

#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <random>

#include "io/crs/names.h"
#include "io/mesh_fixture.h"

namespace arete {
namespace {

using namespace test;
using Json = nlohmann::json;

const TriangleMesh kTwo = {{{0, 0, 1}, {1, 0, 2}, {0, 1, 3}, {1, 1, 4}}, {{0, 1, 2}, {2, 1, 3}}};

std::string glbOf(const std::string& json, const std::string& bytes) {
  std::string text = json;
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::string glb = "glTF";
  const auto put = [&](std::size_t value) {
    const auto number = static_cast<std::uint32_t>(value);
    glb.append(reinterpret_cast<const char*>(&number), 4);
  };
  put(2);
  put(12 + 8 + text.size() + (bytes.empty() ? 0 : 8 + bytes.size()));
  put(text.size());
  glb += "JSON" + text;
  if (bytes.empty()) return glb;
  put(bytes.size());
  return glb + std::string("BIN\0", 4) + bytes;
}

template <class T>
std::string packed(const std::vector<T>& values) {
  std::string bytes(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
  return bytes;
}

/// Four vertices of a square and two triangles over it, as somebody else might write them.
struct Foreign {
  Json json = {
      {"asset", {{"version", "2.0"}}},
      {"scenes", {{{"nodes", {0}}}}},
      {"nodes", {{{"mesh", 0}}}},
      {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}}},
      {"accessors",
       {{{"bufferView", 0}, {"componentType", 5126}, {"count", 4}, {"type", "VEC3"}},
        {{"bufferView", 1}, {"componentType", 5123}, {"count", 6}, {"type", "SCALAR"}}}},
      {"bufferViews",
       {{{"buffer", 0}, {"byteLength", 48}}, {{"buffer", 0}, {"byteOffset", 48}, {"byteLength", 12}}}},
      {"buffers", {{{"byteLength", 60}}}},
  };
  // x, height, -y
  std::string bytes =
      packed<float>({0, 1, 0, 1, 2, 0, 0, 3, -1, 1, 4, -1}) + packed<std::uint16_t>({0, 1, 2, 2, 1, 3});
  std::string glb() const { return glbOf(json.dump(), bytes); }
};

Json jsonOf(const std::string& glb) {
  std::uint32_t length = 0;
  std::memcpy(&length, glb.data() + 12, 4);
  return Json::parse(glb.substr(20, length));
}

TEST(MeshGlb, RoundTripsEveryFamilyWithinItsOwnRounding) {
  const TemporaryFolder folder;
  for (const RasterFamily& family : rasterFamilies()) {
    SCOPED_TRACE(family.name);
    const RasterHeightfield field = family.make(40, 33, 3);
    const TriangleMesh mesh = gridMesh(field);
    const std::string path = folder.file("a.glb");
    for (const char* crs : {"", "EPSG:32611", "EPSG:2225", "EPSG:4326"}) {
      SCOPED_TRACE(crs);
      TriangleMesh placed = mesh;
      const bool isGeographic = std::string_view(crs) == "EPSG:4326";
      if (isGeographic)
        for (Vec3& p : placed.positions) {
          // Some hundredths of a degree, wherever the family stands.
          p.x = -117 + std::remainder(p.x, 1000) / 30000;
          p.y = 34 + std::remainder(p.y, 1000) / 30000;
        }
      const Status written = writeMesh(placed, path, {.crsWkt = crs, .verticalUnit = "ft"});
      ASSERT_TRUE(written) << written.error().describe();
      const Result<MeshFile> file = readMesh(path);
      ASSERT_TRUE(file) << file.error().describe();
      EXPECT_TRUE(file->mesh.validate());
      EXPECT_EQ(file->mesh.triangles, placed.triangles);
      EXPECT_EQ(file->crsWkt, crs);
      EXPECT_EQ(file->verticalUnit, "ft");
      expectSameTriangles(placed, file->mesh, file->frame.rounding);
      ASSERT_TRUE(file->frame.origin);
      EXPECT_LT(file->frame.rounding.z, 0.05);
    }
  }
}

TEST(MeshGlb, SaysTheBoxOfItsPositionsAndUnitNormals) {
  const TemporaryFolder folder;
  const TriangleMesh mesh = gridMesh(rasterFamilies().front().make(20, 20, 1));
  std::vector<float> errors(mesh.triangles.size(), 0.5F);
  errors[0] = 3;
  ASSERT_TRUE(writeMesh(mesh, folder.file("a.glb"), {.crsWkt = "EPSG:32611", .triangleErrors = errors}));
  const std::string glb = bytesOf(folder.file("a.glb"));
  const Json json = jsonOf(glb);
  const std::size_t bin = glb.size() - json["buffers"][0]["byteLength"].get<std::size_t>();
  const auto floatAt = [&](std::size_t accessor, std::size_t i) {
    const Json& view = json["bufferViews"][json["accessors"][accessor]["bufferView"].get<std::size_t>()];
    float value = 0;
    std::memcpy(&value, glb.data() + bin + view["byteOffset"].get<std::size_t>() + 4 * i, 4);
    return value;
  };
  const Json& attributes = json["meshes"][0]["primitives"][0]["attributes"];
  const std::size_t position = attributes["POSITION"], normal = attributes["NORMAL"],
                    error = attributes["_ERROR"];
  for (std::size_t k = 0; k < 3; ++k) {
    float low = floatAt(position, k), high = low;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      low = std::min(low, floatAt(position, 3 * v + k));
      high = std::max(high, floatAt(position, 3 * v + k));
    }
    EXPECT_EQ(json["accessors"][position]["min"][k].get<float>(), low);
    EXPECT_EQ(json["accessors"][position]["max"][k].get<float>(), high);
  }
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    EXPECT_NEAR(std::hypot(floatAt(normal, 3 * v), floatAt(normal, 3 * v + 1), floatAt(normal, 3 * v + 2)), 1,
                1e-6);
    EXPECT_GT(floatAt(normal, 3 * v + 1), 0);  // up
  }
  EXPECT_EQ(floatAt(error, mesh.triangles[0][0]), 3);
  EXPECT_EQ(floatAt(error, mesh.positions.size() - 1), 0.5F);
  EXPECT_EQ(json["asset"]["extras"]["arete"]["linearUnitMetres"], 1);
}

TEST(MeshGlb, TurnsAFootIntoMetres) {
  const TemporaryFolder folder;
  ASSERT_TRUE(writeMesh(kTwo, folder.file("a.glb"), {.crsWkt = "EPSG:32611", .verticalUnit = "ft"}));
  const Json json = jsonOf(bytesOf(folder.file("a.glb")));
  EXPECT_FLOAT_EQ(json["accessors"][0]["max"][1].get<float>(), 4 * 0.3048F);
  EXPECT_EQ(json["asset"]["extras"]["arete"]["verticalUnitMetres"], 0.3048);
  ASSERT_TRUE(writeMesh(kTwo, folder.file("a.glb"), {.verticalUnit = "strange", .verticalUnitMetres = 2}));
  EXPECT_EQ(jsonOf(bytesOf(folder.file("a.glb")))["accessors"][0]["max"][1], 8);
}

TEST(MeshGlb, ReadsWhatOthersWrite) {
  const TemporaryFolder folder;
  Foreign foreign;
  const auto read = [&] { return readMesh(folder.write("a.glb", foreign.glb())); };
  const Result<MeshFile> plain = read();
  ASSERT_TRUE(plain) << plain.error().describe();
  EXPECT_EQ(plain->mesh.positions, kTwo.positions);
  EXPECT_EQ(plain->mesh.triangles, kTwo.triangles);
  EXPECT_FALSE(plain->frame.origin);

  // No scene, no indices, another stride.
  Foreign strided;
  strided.json.erase("scenes");
  strided.json["meshes"][0]["primitives"][0].erase("indices");
  strided.json["accessors"][0]["count"] = 3;
  strided.json["bufferViews"][0] = {{"buffer", 0}, {"byteLength", 48}, {"byteStride", 16}};
  strided.bytes = packed<float>({0, 1, 0, 9, 1, 2, 0, 9, 0, 3, -1, 9, 0, 0, 0});
  const Result<MeshFile> soup = readMesh(folder.write("a.glb", strided.glb()));
  ASSERT_TRUE(soup) << soup.error().describe();
  EXPECT_EQ(soup->mesh.positions, (std::vector<Vec3>{{0, 0, 1}, {1, 0, 2}, {0, 1, 3}}));

  for (const int type : {5121, 5125}) {
    Foreign other;
    other.json["accessors"][1]["componentType"] = type;
    other.bytes.resize(48);
    other.bytes +=
        type == 5121 ? packed<std::uint8_t>({0, 1, 2, 2, 1, 3}) : packed<std::uint32_t>({0, 1, 2, 2, 1, 3});
    other.json["bufferViews"][1]["byteLength"] = other.bytes.size() - 48;
    const Result<MeshFile> file = readMesh(folder.write("a.glb", other.glb()));
    ASSERT_TRUE(file) << file.error().describe();
    EXPECT_EQ(file->mesh.triangles, kTwo.triangles);
  }
}

TEST(MeshGlb, FollowsTheTransformsOfNodes) {
  const TemporaryFolder folder;
  Foreign foreign;
  // Two copies: one moved and enlarged, one turned a quarter round the vertical and mirrored.
  foreign.json["scenes"][0]["nodes"] = {1, 2};
  const double half = std::sqrt(0.5);
  foreign.json["nodes"] = {{{"mesh", 0}, {"translation", {10, 20, 30}}, {"scale", {2, 3, 4}}},
                           {{"children", {0}}},
                           {{"children", {3}}, {"rotation", {0, half, 0, half}}},
                           {{"mesh", 0}, {"matrix", {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}}};
  const Result<MeshFile> file = readMesh(folder.write("a.glb", foreign.glb()));
  ASSERT_TRUE(file) << file.error().describe();
  ASSERT_EQ(file->mesh.positions.size(), 8u);
  EXPECT_EQ(file->mesh.positions[3], (Vec3{12, -26, 32}));  // glTF 12, 32, 26
  const Vec3 turned = file->mesh.positions[7];              // -1, 4, -1 turned: x = z, z = -x
  EXPECT_NEAR(turned.x, -1, 1e-12);
  EXPECT_NEAR(turned.y, -1, 1e-12);
  EXPECT_NEAR(turned.z, 4, 1e-12);
  EXPECT_EQ(file->mesh.triangles[2], (std::array<std::uint32_t, 3>{4, 6, 5}));
}

TEST(MeshGlb, NamesWhatItDoesNotKnow) {
  const TemporaryFolder folder;
  const auto expect = [&](ErrorCode code, const char* said, const std::function<void(Foreign&)>& change) {
    Foreign foreign;
    change(foreign);
    const Error error = refusal(folder.write("a.glb", foreign.glb()));
    EXPECT_EQ(error.code, code) << error.message;
    EXPECT_NE(error.message.find(said), std::string::npos) << error.message;
  };
  using enum ErrorCode;
  expect(unsupported, "KHR_draco_mesh_compression",
         [](Foreign& f) { f.json["extensionsRequired"] = {"KHR_draco_mesh_compression"}; });
  expect(unsupported, "sparse", [](Foreign& f) { f.json["accessors"][0]["sparse"] = Json::object(); });
  expect(unsupported, "outside the GLB", [](Foreign& f) { f.json["buffers"][0]["uri"] = "data.bin"; });
  expect(unsupported, "mode 5", [](Foreign& f) { f.json["meshes"][0]["primitives"][0]["mode"] = 5; });
  expect(unsupported, "32-bit floats", [](Foreign& f) { f.json["accessors"][0]["componentType"] = 5122; });
  expect(unsupported, "skin", [](Foreign& f) { f.json["nodes"][0]["skin"] = 0; });
  expect(unsupported, "no triangle", [](Foreign& f) { f.json["nodes"][0].erase("mesh"); });
  expect(corrupt, "names vertex 9 of 4", [](Foreign& f) { f.bytes[48] = 9; });
  expect(corrupt, "two parents", [](Foreign& f) { f.json["nodes"][0]["children"] = {0}; });
  expect(corrupt, "not three of each", [](Foreign& f) { f.json["accessors"][1]["count"] = 5; });
  expect(corrupt, "not finite", [](Foreign& f) { f.bytes.replace(0, 4, std::string("\0\0\xC0\x7F", 4)); });
  expect(corrupt, "longer than its bufferView", [](Foreign& f) { f.json["accessors"][0]["count"] = 5; });
  expect(corrupt, "longer than its bufferView",
         [](Foreign& f) { f.json["accessors"][0]["count"] = 4294967295U; });
  expect(corrupt, "longer than its bufferView",
         [](Foreign& f) { f.json["accessors"][0]["byteOffset"] = 4294967295U; });
  expect(corrupt, "ends at byte", [](Foreign& f) { f.json["bufferViews"][1]["byteOffset"] = 52; });
  expect(corrupt, "stride", [](Foreign& f) { f.json["bufferViews"][0]["byteStride"] = 4; });
  expect(corrupt, "matrix", [](Foreign& f) { f.json["nodes"][0]["matrix"] = {1, 2, 3}; });
  for (const Json& bad : {Json(-1), Json(1e300), Json("0"), Json(nullptr), Json(0.5), Json(4294967296),
                          Json::array(), Json(99)}) {
    for (const char* place :
         {"/scene", "/scenes/0/nodes/0", "/nodes/0/mesh", "/meshes/0/primitives/0/attributes/POSITION",
          "/meshes/0/primitives/0/indices", "/accessors/0/bufferView", "/accessors/0/componentType",
          "/accessors/0/count", "/bufferViews/0/buffer", "/bufferViews/0/byteLength",
          "/accessors/1/byteOffset"}) {
      Foreign foreign;
      foreign.json[Json::json_pointer(place)] = bad;
      EXPECT_EQ(refusal(folder.write("a.glb", foreign.glb())).code, corrupt) << place << bad;
    }
  }
  for (const char* list : {"scenes", "nodes", "meshes", "accessors", "bufferViews", "buffers"})
    for (const Json& bad : {Json(1), Json("x"), Json::object(), Json::array({1}), Json::array()}) {
      Foreign foreign;
      foreign.json[list] = bad;
      refusal(folder.write("a.glb", foreign.glb()));
    }
}

TEST(MeshGlb, RefusesAFrameThatMakesNoSense) {
  const TemporaryFolder folder;
  ASSERT_TRUE(writeMesh(kTwo, folder.file("a.glb"), {.crsWkt = "EPSG:4326"}));
  const std::string glb = bytesOf(folder.file("a.glb"));
  const Json json = jsonOf(glb);
  const std::string bytes = glb.substr(glb.size() - json["buffers"][0]["byteLength"].get<std::size_t>());
  ASSERT_TRUE(readMesh(folder.write("b.glb", glbOf(json.dump(), bytes))));
  for (const auto& [key, value] : json["asset"]["extras"]["arete"].items()) {
    if (key == "axes") continue;
    Json changed = json;
    for (const Json& bad : {Json(nullptr), Json::object(), Json({1, 2}), Json(-1e308)}) {
      if (key == "middleLongitude" && bad.is_number()) continue;
      changed["asset"]["extras"]["arete"][key] = bad;
      EXPECT_EQ(refusal(folder.write("b.glb", glbOf(changed.dump(), bytes))).code, ErrorCode::corrupt)
          << key << bad;
    }
  }
  EXPECT_EQ(writeMesh({{{0, 91, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, folder.file("c.glb"),
                      {.crsWkt = "EPSG:4326"})
                .error()
                .code,
            ErrorCode::invalidData);
  EXPECT_EQ(writeMesh(kTwo, folder.file("c.glb"), {.crsWkt = "gibberish"}).error().code, ErrorCode::usage);
  EXPECT_EQ(folder.count(), 2u);
}

TEST(MeshGlb, RefusesAFileCutAtAnyByteAndSurvivesDamage) {
  const TemporaryFolder folder;
  ASSERT_TRUE(writeMesh(kTwo, folder.file("a.glb"), {.crsWkt = "EPSG:32611"}));
  std::mt19937 random(4);
  for (const std::string& whole : {bytesOf(folder.file("a.glb")), Foreign{}.glb()}) {
    for (std::size_t length = 0; length < whole.size(); length += 1 + length / 100) {
      const ErrorCode code = refusal(folder.write("b.glb", whole.substr(0, length))).code;
      EXPECT_EQ(code, ErrorCode::corrupt) << length;
    }
    for (std::size_t i = 0; i < whole.size(); ++i) {
      std::string damaged = whole;
      damaged[i] = static_cast<char>(damaged[i] ^ (i % 2 == 0 ? 0x01 : 0x90));
      if (random() % 4 == 0) damaged[random() % damaged.size()] = static_cast<char>(random());
      const Result<MeshFile> file = readMesh(folder.write("b.glb", damaged));
      EXPECT_TRUE(!file || file->mesh.validate());
    }
  }
}

TEST(MeshGlb, DoesNotMultiplyWithoutEnd) {
  const TemporaryFolder folder;
  Foreign foreign;
  Json nodes = Json::array(), numbers = Json::array();
  for (int n = 0; n < 100'000; ++n) {
    nodes.push_back({{"mesh", 0}});
    numbers.push_back(n);
  }
  foreign.json["nodes"] = nodes;
  foreign.json["scenes"][0]["nodes"] = numbers;
  foreign.json["meshes"][0]["primitives"] = Json::array();
  for (int p = 0; p < 100; ++p)
    foreign.json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"indices", 1}});
  EXPECT_EQ(refusal(folder.write("a.glb", foreign.glb())).code, ErrorCode::unsupported);
}

TEST(MeshGlb, HoldsAnEmptyMesh) {
  const TemporaryFolder folder;
  ASSERT_TRUE(writeMesh(TriangleMesh{}, folder.file("a.glb"), {.crsWkt = "EPSG:4326"}));
  const Result<MeshFile> file = readMesh(folder.file("a.glb"));
  ASSERT_TRUE(file) << file.error().describe();
  EXPECT_TRUE(file->mesh.triangles.empty());
  EXPECT_EQ(file->crsWkt, "EPSG:4326");
}

}  // namespace
}  // namespace arete
