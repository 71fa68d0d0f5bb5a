// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rotations that are not of length 1, and scenes of many instances.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "io/formats/glb/glb.h"
#include "io/glb_fixture.h"
#include "io/io_fixture.h"

namespace arete {
namespace {

using namespace test;

double areaOf(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles)
    sum += norm(cross(mesh.positions[t[1]] - mesh.positions[t[0]],
                      mesh.positions[t[2]] - mesh.positions[t[0]])) /
           2;
  return sum;
}

TEST(GltfRotations, AreMadeOfLengthOne) {
  const TemporaryFolder folder;
  struct Case {
    std::array<double, 4> rotation;
    bool isSaid;
  };
  const double h = std::sqrt(0.5);
  const std::vector<Case> cases = {
      {{0, 0, 2, 2}, true},          {{0, 0, h, h}, false},          {{0, 0, 0.7071, 0.7071}, false},
      {{0, 0, 0.707, 0.707}, false}, {{0, 0, 0.5, 0.5}, true},       {{1, 2, 3, 4}, true},
      {{0, 0, 0, -1}, false},        {{0, 0, 0, 3}, true},           {{1e-3, 0, 0, 0}, true},
      {{1e200, 0, 0, 1e200}, true},  {{1e-200, 1e-200, 0, 0}, true}, {{0.999, 0, 0, 0}, false},
  };
  Foreign foreign;
  const double area = areaOf(readGlb(folder.write("a.glb", foreign.glb()))->mesh);
  for (const auto& [rotation, isSaid] : cases) {
    foreign.json["nodes"][0]["rotation"] = rotation;
    const Result<MeshFile> file = readGlb(folder.write("a.glb", foreign.glb()));
    ASSERT_TRUE(file) << file.error().describe();
    EXPECT_NEAR(areaOf(file->mesh), area, 1e-12 * area) << rotation[2] << ' ' << rotation[3];
    EXPECT_EQ(file->warnings.size(), isSaid ? 1u : 0u) << rotation[2] << ' ' << rotation[3];
    // By the quaternion itself: p' = q p q*.
    const double length =
        std::hypot(std::hypot(rotation[0], rotation[1]), std::hypot(rotation[2], rotation[3]));
    const Vec3 v = Vec3{rotation[0] / length, rotation[1] / length, rotation[2] / length};
    const double w = rotation[3] / length;
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3 p = kTwoYUp.positions[i], u = cross(v, p);
      const Vec3 wanted = p + u * (2 * w) + cross(v, u) * 2.0;
      EXPECT_LT(norm(file->mesh.positions[i] - wanted), 1e-12);
    }
  }
}

TEST(GltfRotations, OfZeroAreRefusedByTheirNode) {
  const TemporaryFolder folder;
  Foreign foreign;
  foreign.json["nodes"][0]["rotation"] = {0, 0, 0, 0};
  const Result<MeshFile> file = readGlb(folder.write("a.glb", foreign.glb()));
  ASSERT_FALSE(file);
  EXPECT_EQ(file.error().code, ErrorCode::corrupt);
  EXPECT_NE(file.error().message.find("node 0: has a rotation that is 0, 0, 0, 0"), std::string::npos)
      << file.error().message;
}

TEST(GltfRotations, OfInstancesToo) {
  const TemporaryFolder folder;
  for (const double length : {1.0, 2.0, 0.0}) {
    Foreign foreign;
    foreign.bytes += packed<float>({0, 0, 0, 1, 0, 0, float(length), 0});
    foreign.json["buffers"][0]["byteLength"] = foreign.bytes.size();
    foreign.json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 60}, {"byteLength", 32}});
    foreign.json["accessors"].push_back(
        {{"bufferView", 2}, {"componentType", 5126}, {"count", 2}, {"type", "VEC4"}});
    foreign.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["ROTATION"] = 2;
    const Result<MeshFile> file = readGlb(folder.write("a.glb", foreign.glb()));
    EXPECT_EQ(file.has_value(), length > 0);
    if (!file) {
      EXPECT_NE(file.error().message.find("node 0: instance 1"), std::string::npos) << file.error().message;
      continue;
    }
    EXPECT_EQ(file->warnings.size(), length == 1 ? 0u : 1u);
    EXPECT_NEAR(areaOf(file->mesh), 2 * areaOf(kTwoYUp), 1e-6);
  }
}

/// `instances` of a fan of `triangles`, in a file of few bytes for each.
std::string manyTimes(std::uint32_t triangles, std::uint32_t instances) {
  std::vector<float> positions, places;
  std::vector<std::uint32_t> indices;
  for (std::uint32_t i = 0; i < triangles + 2; ++i)
    positions.insert(positions.end(), {float(i), float(i % 2), float(i % 3)});
  for (std::uint32_t t = 0; t < triangles; ++t) indices.insert(indices.end(), {t, t + 1, t + 2});
  for (std::uint32_t i = 0; i < instances; ++i) places.insert(places.end(), {float(i), 0, 0});
  const std::string a = packed(positions), b = packed(indices), c = packed(places);
  Foreign foreign;
  foreign.bytes = a + b + c;
  foreign.json["accessors"] = {
      {{"bufferView", 0}, {"componentType", 5126}, {"count", triangles + 2}, {"type", "VEC3"}},
      {{"bufferView", 1}, {"componentType", 5125}, {"count", 3 * triangles}, {"type", "SCALAR"}},
      {{"bufferView", 2}, {"componentType", 5126}, {"count", instances}, {"type", "VEC3"}}};
  foreign.json["bufferViews"] = {
      {{"buffer", 0}, {"byteLength", a.size()}},
      {{"buffer", 0}, {"byteOffset", a.size()}, {"byteLength", b.size()}},
      {{"buffer", 0}, {"byteOffset", a.size() + b.size()}, {"byteLength", c.size()}}};
  foreign.json["buffers"][0]["byteLength"] = foreign.bytes.size();
  foreign.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = 2;
  return foreign.glb();
}

TEST(GltfInstances, AreReadBeyondTheSizeOfTheFile) {
  const TemporaryFolder folder;
  const Result<MeshFile> file = readGlb(folder.write("a.glb", manyTimes(600, 3000)));
  ASSERT_TRUE(file) << file.error().describe();
  EXPECT_EQ(file->mesh.triangles.size(), 1'800'000u);
}

TEST(GltfInstances, BeyondTheMemoryOfTheMachineAreInvalidDataThatSaysSo) {
  const TemporaryFolder folder;
  // 400 000 triangles at 100 000 places: 40 billion.
  const Result<MeshFile> file = readGlb(folder.write("a.glb", manyTimes(400'000, 100'000)));
  ASSERT_FALSE(file);
  EXPECT_EQ(file.error().code, ErrorCode::invalidData);
  EXPECT_NE(file.error().message.find("GiB of memory"), std::string::npos) << file.error().message;
}

}  // namespace
}  // namespace arete
