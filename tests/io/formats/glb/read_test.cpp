// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/glb/glb.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <set>

#include "io/geo/crs/names.h"
#include "io/glb_fixture.h"
#include "io/mesh_fixture.h"
#include "sentences_of.h"

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
  EXPECT_EQ(plain->mesh.positions, kTwoYUp.positions);
  EXPECT_EQ(plain->up, MeshUp::y);
  EXPECT_TRUE(plain->mesh.objects.empty() && plain->mesh.objectOf.empty()) << "one object without a name";
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
  EXPECT_EQ(soup->mesh.positions, (std::vector<Vec3>{{0, 1, 0}, {1, 2, 0}, {0, 3, -1}}));

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
  EXPECT_EQ(file->mesh.positions[3], (Vec3{12, 32, 26}));
  const Vec3 turned = file->mesh.positions[7];  // -1, 4, -1 turned: x = z, z = -x
  EXPECT_NEAR(turned.x, -1, 1e-12);
  EXPECT_NEAR(turned.y, 4, 1e-12);
  EXPECT_NEAR(turned.z, 1, 1e-12);
  EXPECT_EQ(file->mesh.triangles[2], (std::array<std::uint32_t, 3>{4, 6, 5}));
}

TEST(GlbRead, NamesObjectsByTheirNodesElseByTheirMeshes) {
  const TemporaryFolder folder;
  Foreign foreign;
  foreign.json["scenes"][0]["nodes"] = {0, 1, 2};
  foreign.json["meshes"] = {{{"name", "chair"}, {"primitives", foreign.json["meshes"][0]["primitives"]}},
                            {{"primitives", foreign.json["meshes"][0]["primitives"]}}};
  foreign.json["nodes"] = {
      {{"mesh", 0}, {"name", "left"}, {"translation", {9, 0, 0}}}, {{"mesh", 0}}, {{"mesh", 1}}};
  const Result<MeshFile> file = readMesh(folder.write("a.glb", foreign.glb()));
  ASSERT_TRUE(file) << file.error().describe();
  EXPECT_EQ(file->mesh.objects, (std::vector<std::string>{"left", "chair", ""}));
  EXPECT_EQ(file->mesh.objectOf, (std::vector<std::uint32_t>{0, 0, 1, 1, 2, 2}));
  // The last two stand at one place with one accessor: they share vertices. The first is a copy.
  EXPECT_EQ(file->mesh.positions.size(), 8u);
  EXPECT_EQ(file->mesh.triangles[4], file->mesh.triangles[2]);
}

TEST(GlbRead, KeepsTheVerticesWithoutATriangleOfAFileOfItsOwn) {
  const TemporaryFolder folder;
  Foreign foreign;
  foreign.json["accessors"][1]["count"] = 3;
  EXPECT_EQ(readMesh(folder.write("a.glb", foreign.glb()))->mesh.positions.size(), 3u);
  foreign.json["asset"]["generator"] = "Arete";
  EXPECT_EQ(readMesh(folder.write("a.glb", foreign.glb()))->mesh.positions.size(), 4u);
}

TEST(GlbRead, PlacesInstances) {
  const TemporaryFolder folder;
  Foreign foreign;
  // EXT_mesh_gpu_instancing: translation, rotation by a quarter round y as normalized bytes, scale.
  foreign.bytes += packed<float>({10, 0, 0, 20, 0, 0}) + packed<std::int8_t>({0, 0, 0, 127, 0, 127, 0, 0}) +
                   packed<float>({1, 1, 1, 2, 2, 2});
  for (const auto& [offset, length] : {std::pair{60, 24}, {84, 8}, {92, 24}})
    foreign.json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", length}});
  foreign.json["accessors"].push_back(
      {{"bufferView", 2}, {"componentType", 5126}, {"count", 2}, {"type", "VEC3"}});
  foreign.json["accessors"].push_back(
      {{"bufferView", 3}, {"componentType", 5120}, {"normalized", true}, {"count", 2}, {"type", "VEC4"}});
  foreign.json["accessors"].push_back(
      {{"bufferView", 4}, {"componentType", 5126}, {"count", 2}, {"type", "VEC3"}});
  foreign.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  foreign.json["nodes"][0]["translation"] = {0, 100, 0};
  foreign.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", 2}, {"ROTATION", 3}, {"SCALE", 4}, {"_ID", 2}};
  const Result<MeshFile> file = readMesh(folder.write("a.glb", foreign.glb()));
  ASSERT_TRUE(file) << file.error().describe();
  ASSERT_EQ(file->mesh.positions.size(), 8u);
  EXPECT_EQ(file->mesh.positions[3], (Vec3{11, 104, -1}));
  EXPECT_EQ(file->mesh.positions[7], (Vec3{18, 108, 2}));  // half a turn round y: x and z turn, then twice
  EXPECT_TRUE(contains(joined(file->warnings), "1 attribute of instances is left out"));
  foreign.json["accessors"][2]["count"] = 1;
  EXPECT_TRUE(contains(refusal(folder.write("a.glb", foreign.glb())).message, "several counts"));
}

TEST(GlbRead, NamesWhatItLeavesOut) {
  const TemporaryFolder folder;
  Foreign foreign;
  foreign.json["nodes"][0]["skin"] = 0;
  foreign.json["nodes"][0]["translation"] = {5, 0, 0};
  foreign.json["skins"] = {{{"joints", {0}}}};
  foreign.json["animations"] = {{{"name", "run"}}, {{"name", "jump\x1b"}}};
  foreign.json["cameras"] = Json::array({Json::object()});  // of braces alone compilers make either
  foreign.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"name", "sun"}}};
  foreign.json["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "red"}}, {{"name", "blue"}}};
  foreign.json["extensionsUsed"] = {"KHR_lights_punctual", "VENDOR_thing", "KHR_materials_unlit"};
  foreign.json["scenes"].push_back({{"nodes", Json::array()}});
  foreign.json["meshes"].push_back({{"primitives", Json::array()}});
  Json& mesh = foreign.json["meshes"][0];
  mesh["primitives"][0]["targets"] = {{{"POSITION", 0}}};
  mesh["weights"] = {1};
  mesh["extras"]["targetNames"] = {"smile"};
  mesh["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 1}});
  mesh["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 3}});
  mesh["primitives"][0]["attributes"]["JOINTS_0"] = 0;
  mesh["primitives"][0]["attributes"]["WEIGHTS_0"] = 0;
  mesh["primitives"][0]["attributes"]["NORMAL"] = 1;
  const Result<MeshFile> file = readMesh(folder.write("a.glb", foreign.glb()));
  ASSERT_TRUE(file) << file.error().describe();
  EXPECT_EQ(file->mesh.positions[1], (Vec3{7, 4, 0})) << "moved by the target and put by the node";
  EXPECT_TRUE(file->mesh.vertexAttributes.empty());
  EXPECT_EQ(test::sentencesOf(file->warnings),
            (std::vector<std::string>{
                "2 primitives of points or lines are left out",
                "the skin of 1 node is left out: its mesh stands where the node places it",
                "2 animations (\"run\", \"jump?\") are left out",
                "1 morph target (\"smile\") is left out; those with a weight have moved the vertices",
                "1 camera is left out", "1 light (\"sun\") is left out",
                "2 variants of materials (\"red\", \"blue\") are left out", "1 further scene is left out",
                "1 mesh that the scene does not show is left out",
                "the attribute \"NORMAL\" is left out: it has 1 components",
                "1 extension (\"VENDOR_thing\") is left out"}));
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
  EXPECT_EQ(positions(), kTwoYUp.positions);  // without weights they do not move
  foreign.json["meshes"][0]["weights"] = {0.5, 0, 1};
  EXPECT_EQ(positions(), (std::vector<Vec3>{{0, 1, 0}, {1.5, 2, 0}, {0, 7, -1}, {1, 4, -3}}));
  // The weights of the node come before those of the mesh.
  foreign.json["nodes"][0]["weights"] = {0, 1, 0};
  EXPECT_EQ(positions()[0], (Vec3{9, 10, 9}));
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
  expect(unsupported, "EXT_texture_video",
         [](Foreign& f) { f.json["extensionsRequired"] = {"EXT_texture_video"}; });
  expect(corrupt, "\"extensionsRequired\"", [](Foreign& f) { f.json["extensionsRequired"] = 1; });
  expect(corrupt, "\"count\"", [](Foreign& f) { f.json["accessors"][0]["sparse"] = Json::object(); });
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
  expect(corrupt, "mode 7", [](Foreign& f) { f.json["meshes"][0]["primitives"][0]["mode"] = 7; });
  expect(unsupported, "1 primitive of points or lines is left out",
         [](Foreign& f) { f.json["meshes"][0]["primitives"][0]["mode"] = 0; });
  expect(unsupported, "1 primitive without positions is left out",
         [](Foreign& f) { f.json["meshes"][0]["primitives"][0]["attributes"] = Json::object(); });
  expect(corrupt, "component type 5127", [](Foreign& f) { f.json["accessors"][0]["componentType"] = 5127; });
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
  {
    // Zeros without bytes, one strip of them without triangles, and as many instances as a number can say.
    Assembled many = oneTriangle();
    many.json["accessors"].push_back({{"componentType", 5126}, {"count", 4294967295U}, {"type", "VEC3"}});
    many.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["SCALE"] = 1;
    EXPECT_EQ(refusal(folder.write("a.glb", many.glb())).code, ErrorCode::unsupported);
    Assembled zeros = oneTriangle();
    zeros.json["accessors"][0] = {{"componentType", 5126}, {"count", 4294967292U}, {"type", "VEC3"}};
    EXPECT_EQ(refusal(folder.write("a.glb", zeros.glb())).code, ErrorCode::invalidData);
    zeros.primitive()["mode"] = 5;
    EXPECT_EQ(refusal(folder.write("a.glb", zeros.glb())).code, ErrorCode::invalidData);
    // Sparse zeros.
    zeros.json["accessors"][0]["sparse"] = {{"count", 1},
                                            {"indices", {{"bufferView", 0}, {"componentType", 5125}}},
                                            {"values", {{"bufferView", 0}}}};
    EXPECT_EQ(refusal(folder.write("a.glb", zeros.glb())).code, ErrorCode::unsupported);
    // One accessor as ten thousand attributes.
    Assembled attributes;
    attributes.attributes()["POSITION"] = attributes.add(std::vector<float>(3 * 99'999, 1), "VEC3");
    for (int a = 0; a < 10'000; ++a) attributes.attributes()["_" + std::to_string(a)] = 0;
    EXPECT_EQ(refusal(folder.write("a.glb", attributes.glb())).code, ErrorCode::unsupported);
  }
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
