// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/glb/glb.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "io/glb_fixture.h"
#include "io/mesh_fixture.h"

namespace arete {
namespace {

using namespace test;

TEST(GlbWrite, SaysTheBoxOfItsPositionsAndUnitNormals) {
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

TEST(GlbWrite, TurnsAFootIntoMetres) {
  const TemporaryFolder folder;
  ASSERT_TRUE(writeMesh(kTwo, folder.file("a.glb"), {.crsWkt = "EPSG:32611", .verticalUnit = "ft"}));
  const Json json = jsonOf(bytesOf(folder.file("a.glb")));
  EXPECT_FLOAT_EQ(json["accessors"][0]["max"][1].get<float>(), 4 * 0.3048F);
  EXPECT_EQ(json["asset"]["extras"]["arete"]["verticalUnitMetres"], 0.3048);
  ASSERT_TRUE(writeMesh(kTwo, folder.file("a.glb"), {.verticalUnit = "strange", .verticalUnitMetres = 2}));
  EXPECT_EQ(jsonOf(bytesOf(folder.file("a.glb")))["accessors"][0]["max"][1], 8);
}

TEST(GlbWrite, IsInMetresOnTheGroundOfAStretchedMap) {
  const TemporaryFolder folder;
  const double y60 =
      8399737.89;  // 60 degrees north in EPSG:3857, where a metre on the ground is two on the map
  const TriangleMesh mesh{{{1e6, y60, 10}, {1e6 + 2000, y60, 30}, {1e6, y60 + 2000, 50}}, {{0, 1, 2}}};
  ASSERT_TRUE(writeMesh(mesh, folder.file("a.glb"), {.crsWkt = "EPSG:3857"}));
  const Json json = jsonOf(bytesOf(folder.file("a.glb")));
  const Json& box = json["accessors"][0];
  EXPECT_NEAR(box["max"][0].get<double>() - box["min"][0].get<double>(), 1000, 6);
  EXPECT_NEAR(box["max"][2].get<double>() - box["min"][2].get<double>(), 1000, 6);
  EXPECT_EQ(box["max"][1].get<double>() - box["min"][1].get<double>(), 40) << "heights are metres already";
  const Result<MeshFile> back = readMesh(folder.file("a.glb"));
  ASSERT_TRUE(back) << back.error().describe();
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(back->mesh.positions[i].x, mesh.positions[i].x, 2e-4);
    EXPECT_NEAR(back->mesh.positions[i].y, mesh.positions[i].y, 2e-4);
  }
}

TEST(GlbWrite, HoldsAnEmptyMesh) {
  const TemporaryFolder folder;
  ASSERT_TRUE(writeMesh(TriangleMesh{}, folder.file("a.glb"), {.crsWkt = "EPSG:4326"}));
  const Result<MeshFile> file = readMesh(folder.file("a.glb"));
  ASSERT_TRUE(file) << file.error().describe();
  EXPECT_TRUE(file->mesh.triangles.empty());
  EXPECT_EQ(file->crsWkt, "EPSG:4326");
}

}  // namespace
}  // namespace arete
