// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mesh/glb/glb.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <set>

#include "io/crs/names.h"
#include "io/glb_fixture.h"
#include "io/mesh_fixture.h"

namespace arete {
namespace {

using namespace test;

TEST(GlbRead, RoundTripsEveryFamilyWithinItsOwnRounding) {
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
      const auto written = writeMesh(placed, path, {.crsWkt = crs, .verticalUnit = "ft"});
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

TEST(GlbRead, ReadsWhatOthersWrite) {
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

TEST(GlbRead, FollowsTheTransformsOfNodes) {
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

TEST(GlbRead, GivesPrimitivesThatShareAnAccessorTheVerticesThatTheyUse) {
  const TemporaryFolder folder;
  // One accessor of 3 000 positions, of which 48 primitives use a few each, some the same ones.
  Foreign foreign;
  std::vector<float> positions;
  for (int v = 0; v < 3000; ++v) positions.insert(positions.end(), {float(v), float(v % 7), float(-v % 11)});
  std::vector<std::uint16_t> indices;
  std::set<std::uint16_t> used;
  std::mt19937 random(7);
  Json primitives = Json::array(),
       accessors = {{{"bufferView", 0}, {"componentType", 5126}, {"count", 3000}, {"type", "VEC3"}}};
  for (int p = 0; p < 48; ++p) {
    accessors.push_back({{"bufferView", 1},
                         {"byteOffset", indices.size() * 2},
                         {"componentType", 5123},
                         {"count", 3},
                         {"type", "SCALAR"}});
    primitives.push_back({{"attributes", {{"POSITION", 0}}}, {"indices", p + 1}});
    for (int k = 0; k < 3; ++k) {
      indices.push_back(std::uint16_t(100 * (random() % 20) + 17));
      used.insert(indices.back());
    }
  }
  foreign.json["accessors"] = accessors;
  foreign.json["meshes"][0]["primitives"] = primitives;
  foreign.json["bufferViews"] = {{{"buffer", 0}, {"byteLength", 36000}},
                                 {{"buffer", 0}, {"byteOffset", 36000}, {"byteLength", 288}}};
  foreign.bytes = packed(positions) + packed(indices);
  for (const bool inOneMesh : {true, false}) {
    if (!inOneMesh) {
      // Each in a mesh of its own: meshes are not joined.
      Json meshes = Json::array(), nodes = Json::array(), roots = Json::array();
      for (int p = 0; p < 48; ++p) {
        meshes.push_back({{"primitives", Json::array({primitives[std::size_t(p)]})}});
        nodes.push_back({{"mesh", p}});
        roots.push_back(p);
      }
      foreign.json["meshes"] = meshes;
      foreign.json["nodes"] = nodes;
      foreign.json["scenes"][0]["nodes"] = roots;
    }
    const Result<MeshFile> file = readMesh(folder.write("a.glb", foreign.glb()));
    ASSERT_TRUE(file) << file.error().describe();
    ASSERT_EQ(file->mesh.triangles.size(), 48u);
    EXPECT_TRUE(file->mesh.positions.size() == used.size() || !inOneMesh) << file->mesh.positions.size();
    EXPECT_LE(file->mesh.positions.size(), 144u);
    for (std::size_t t = 0; t < 48; ++t)
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_EQ(file->mesh.positions[file->mesh.triangles[t][k]].x, indices[3 * t + k]);
  }
}

TEST(GlbRead, AppliesMorphTargetsByTheirWeights) {
  const TemporaryFolder folder;
  Foreign foreign;
  foreign.bytes += packed<float>({0, 0, 0, 1, 0, 0, 0, 8, 0, 0, 0, -4}) +
                   packed<float>({9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9});
  for (const int offset : {60, 108}) {
    foreign.json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", 48}});
    foreign.json["accessors"].push_back(
        {{"bufferView", offset == 60 ? 2 : 3}, {"componentType", 5126}, {"count", 4}, {"type", "VEC3"}});
  }
  foreign.json["meshes"][0]["primitives"][0]["targets"] = {
      {{"POSITION", 2}}, {{"POSITION", 3}}, {{"NORMAL", 3}}};
  const auto positions = [&] { return readMesh(folder.write("a.glb", foreign.glb()))->mesh.positions; };
  EXPECT_EQ(positions(), kTwo.positions);  // without weights they do not move
  foreign.json["meshes"][0]["weights"] = {0.5, 0, 1};
  // In glTF 1.5, 2, 0; 0, 7, -1; 1, 4, -3.
  EXPECT_EQ(positions(), (std::vector<Vec3>{{0, 0, 1}, {1.5, 0, 2}, {0, 1, 7}, {1, 3, 4}}));
  // The weights of the node come before those of the mesh.
  foreign.json["nodes"][0]["weights"] = {0, 1, 0};
  EXPECT_EQ(positions()[0], (Vec3{9, -9, 10}));
  // Two primitives with one accessor and other targets are two sets of vertices.
  foreign.json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"indices", 1}});
  EXPECT_EQ(positions().size(), 8u);
}

TEST(GlbRead, NamesWhatItDoesNotKnow) {
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
  expect(notFound, "\"data.bin\"", [](Foreign& f) { f.json["buffers"][0]["uri"] = "data.bin"; });
  expect(corrupt, "3 weights", [](Foreign& f) {
    f.json["meshes"][0]["weights"] = {1, 0, 0};
    f.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", 0}}};
  });
  expect(corrupt, "morph target of 2", [](Foreign& f) {
    f.json["meshes"][0]["weights"] = {1};
    f.json["accessors"].push_back(f.json["accessors"][0]);
    f.json["accessors"][2]["count"] = 2;
    f.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", 2}}};
  });
  expect(corrupt, "weights", [](Foreign& f) { f.json["nodes"][0]["weights"] = {"a"}; });
  expect(corrupt, "targets", [](Foreign& f) { f.json["meshes"][0]["primitives"][0]["targets"] = 1; });
  expect(unsupported, "mode 5", [](Foreign& f) { f.json["meshes"][0]["primitives"][0]["mode"] = 5; });
  expect(unsupported, "32-bit floats", [](Foreign& f) { f.json["accessors"][0]["componentType"] = 5122; });
  expect(unsupported, "skin", [](Foreign& f) { f.json["nodes"][0]["skin"] = 0; });
  expect(unsupported, "no triangle", [](Foreign& f) { f.json["nodes"][0].erase("mesh"); });
  expect(corrupt, "names vertex 9 of 4", [](Foreign& f) { f.bytes[48] = 9; });
  expect(corrupt, "two parents", [](Foreign& f) { f.json["nodes"][0]["children"] = {0}; });
  expect(corrupt, "not a multiple of three", [](Foreign& f) { f.json["accessors"][1]["count"] = 5; });
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

TEST(GlbRead, RefusesAFileCutAtAnyByteAndSurvivesDamage) {
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

TEST(GlbRead, DoesNotMultiplyWithoutEnd) {
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

}  // namespace
}  // namespace arete
