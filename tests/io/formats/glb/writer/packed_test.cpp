// SPDX-License-Identifier: GPL-3.0-or-later
//
// Packed files are read back by the reader, which shares nothing with the encoders.
#include "io/formats/glb/writer/packed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "io/formats/common/colors.h"
#include "io/formats/exchange/mesh_formats.h"
#include "io/formats/glb/meshopt.h"
#include "io/written_glb.h"

namespace arete {
namespace {

using namespace test;

/// A file that was packed, what was lost, and the file as it is read.
struct Packed {
  MeshFile file;
  std::vector<std::string> lost;
  Json json;
  std::size_t bytes = 0;

  bool hasLost(const std::string& part) const {
    return std::ranges::any_of(lost, [&](const std::string& what) { return what.find(part) != what.npos; });
  }
};

Packed packed(const SurfaceMesh& mesh, int bits, MeshWriteOptions options = {.up = MeshUp::y}) {
  TemporaryFolder folder;
  const std::string path = folder.file("a.glb");
  options.packing = MeshPacking{.positionBits = bits};
  Packed result;
  const Result<MeshWriteReport> report = writeMesh(mesh, path, options);
  if (!report) {
    ADD_FAILURE() << report.error().describe();
    return result;
  }
  result.lost = report->lost;
  const std::string glb = bytesOf(path);
  result.bytes = glb.size();
  result.json = jsonOf(glb);
  Result<MeshFile> file = readMesh(path);
  if (!file) ADD_FAILURE() << file.error().describe();
  if (file) result.file = std::move(*file);
  return result;
}

/// A ball of rings, which has no border but in the parameters.
SurfaceMesh ball(std::uint32_t rings, Vec3 middle = {}) {
  SurfaceMesh mesh;
  const std::uint32_t round = 2 * rings;
  for (std::uint32_t r = 0; r <= rings; ++r)
    for (std::uint32_t c = 0; c < round; ++c) {
      const double down = std::numbers::pi * r / rings, turn = 2 * std::numbers::pi * c / round;
      mesh.positions.push_back({middle.x + std::sin(down) * std::cos(turn), middle.y + std::cos(down),
                                middle.z + std::sin(down) * std::sin(turn)});
      if (r == rings) continue;
      const std::uint32_t a = r * round + c, b = r * round + (c + 1) % round;
      if (r > 0) mesh.triangles.push_back({a, b, b + round});
      if (r + 1 < rings) mesh.triangles.push_back({a, b + round, a + round});
    }
  return mesh;
}

double apart(const Vec3& p, const Vec3& q) {
  return std::max({std::abs(p.x - q.x), std::abs(p.y - q.y), std::abs(p.z - q.z)});
}

/// By vertex of the file, the nearest vertex of the mesh.
std::vector<std::uint32_t> nearest(const SurfaceMesh& mesh, const MeshFile& file) {
  std::vector<std::uint32_t> result;
  for (const Vec3& p : file.mesh.positions) {
    std::uint32_t best = 0;
    for (std::uint32_t v = 1; v < mesh.positions.size(); ++v)
      if (apart(p, mesh.positions[v]) < apart(p, mesh.positions[best])) best = v;
    result.push_back(best);
  }
  return result;
}

/// A triangle that begins with its least vertex.
std::array<std::uint32_t, 3> turned(std::array<std::uint32_t, 3> t) {
  std::ranges::rotate(t, std::ranges::min_element(t));
  return t;
}

TEST(PackedGltf, MovesNoVertexByMoreThanTheFileStatesAndKeepsTheTriangles) {
  for (const int bits : {8, 11, 14, 16}) {
    SCOPED_TRACE(bits);
    SurfaceMesh mesh = ball(12, {100, -3, 7});
    const Packed file = packed(mesh, bits);
    const double half = file.json["nodes"][0]["scale"][0].get<double>() / 2;
    EXPECT_NEAR(half, 1.0 / ((1 << bits) - 1), 1e-6);
    EXPECT_GE(file.file.frame.rounding.x, half);
    EXPECT_LE(file.file.frame.rounding.x, half + 1e-5);
    const std::vector<std::uint32_t> of = nearest(mesh, file.file);
    for (std::size_t v = 0; v < of.size(); ++v)
      EXPECT_LE(apart(file.file.mesh.positions[v], mesh.positions[of[v]]), file.file.frame.rounding.x);
    std::multiset<std::array<std::uint32_t, 3>> before, after;
    // The poles are as many vertices at one place as a ring has.
    for (const auto& t : mesh.triangles)
      if (t[0] >= 24 && t[2] < 12 * 24) before.insert(turned(t));
    for (const auto& t : file.file.mesh.triangles) {
      const std::array<std::uint32_t, 3> there = {of[t[0]], of[t[1]], of[t[2]]};
      if (std::ranges::all_of(there, [](std::uint32_t v) { return v >= 24 && v < 12 * 24; }))
        after.insert(turned(there));
    }
    std::erase_if(before, [](const auto& t) {
      return !std::ranges::all_of(t, [](std::uint32_t v) { return v >= 24 && v < 12 * 24; });
    });
    EXPECT_EQ(before, after) << "in any order, and facing as before";
    EXPECT_EQ(file.file.mesh.triangles.size(), mesh.triangles.size());
    EXPECT_TRUE(file.hasLost("coordinates finer than"));
  }
}

TEST(PackedGltf, RequiresWhatAReaderMustKnow) {
  const Packed file = packed(ball(4), 14);
  const std::set<std::string> required = file.json["extensionsRequired"];
  EXPECT_EQ(required, (std::set<std::string>{"EXT_meshopt_compression", "KHR_mesh_quantization"}));
  for (const Json& view : file.json["bufferViews"]) EXPECT_EQ(view.value("byteStride", 4) % 4, 0);
  EXPECT_EQ(file.json["buffers"].size(), 2u);
  EXPECT_TRUE(file.json["buffers"][1]["extensions"]["EXT_meshopt_compression"]["fallback"]);
  EXPECT_FALSE(file.json["buffers"][1].contains("uri"));
}

// What other packers do with a grid for each mesh: parts that touched come apart.
TEST(PackedGltf, HasOneGridForAllPartsSoThatTheyStayTogether) {
  SurfaceMesh mesh = ball(10);
  mesh.objects = {"upper", "lower"};
  mesh.materials.resize(2);
  for (const auto& t : mesh.triangles) {
    const double y = mesh.positions[t[0]].y + mesh.positions[t[1]].y + mesh.positions[t[2]].y;
    mesh.objectOf.push_back(y > 0 ? 0 : 1);
    mesh.materialOf.push_back(t[0] % 2);
  }
  const Packed file = packed(mesh, 9);
  ASSERT_EQ(file.json["nodes"].size(), 2u);
  EXPECT_EQ(file.json["nodes"][0]["translation"], file.json["nodes"][1]["translation"]);
  EXPECT_EQ(file.json["nodes"][0]["scale"], file.json["nodes"][1]["scale"]);
  const std::vector<std::uint32_t> of = nearest(mesh, file.file);
  std::map<std::uint32_t, Vec3> placeOf;
  std::size_t shared = 0;
  for (std::size_t v = 0; v < of.size(); ++v) {
    const auto [found, isNew] = placeOf.try_emplace(of[v], file.file.mesh.positions[v]);
    if (isNew) continue;
    ++shared;
    EXPECT_EQ(found->second, file.file.mesh.positions[v]) << "of vertex " << of[v];
  }
  EXPECT_GE(shared, 20u) << "along the equator";
}

TEST(PackedGltf, CountsThePlacesThatFallTogetherAndTheTrianglesThatLoseTheirArea) {
  SurfaceMesh mesh = square();
  for (Vec3& p : mesh.positions) p.z = 0;
  mesh.positions.push_back({1, 1.001, 0});
  mesh.triangles.push_back({2, 3, 4});
  const Packed coarse = packed(mesh, 4), fine = packed(mesh, 14);
  EXPECT_TRUE(coarse.hasLost("1 place falls together with others")) << coarse.lost.front();
  EXPECT_TRUE(coarse.hasLost("1 triangle, which has no area on its grid"));
  EXPECT_FALSE(fine.hasLost("together"));
  EXPECT_FALSE(fine.hasLost("no area"));
  EXPECT_EQ(coarse.file.mesh.triangles.size(), 3u) << "which stay";
}

TEST(PackedGltf, KeepsTextureCoordinatesWithinWhatItSaysAlsoBeyondThePicture) {
  for (const double largest : {1.0, 7.25, 5000.0}) {
    SCOPED_TRACE(largest);
    SurfaceMesh mesh = square();
    Attribute uv = attribute("texcoord", AttributeMeaning::textureCoords, ScalarType::float32, 2,
                             {0, 1, -3.5, 0.123456, 0.25, 0.75, largest, 0.333333});
    uv.isFromTop = true;
    mesh.vertexAttributes = {uv};
    const Packed file = packed(mesh, 16);
    const double step = largest > 2048 ? 0x1p-10 : 0x1p-12;
    EXPECT_TRUE(file.hasLost("texture coordinates finer than"));
    EXPECT_FALSE(file.json.contains("extensionsUsed") &&
                 file.json["extensionsUsed"].dump().find("texture_transform") != std::string::npos);
    const std::vector<std::uint32_t> of = nearest(mesh, file.file);
    const Attribute& back = file.file.mesh.vertexAttributes.at(0);
    for (std::size_t v = 0; v < 4; ++v) {
      const std::vector<double> was = uv.numbers(of[v]), is = back.numbers(v);
      for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_NEAR(is[k], was[k], step / 2);
        EXPECT_TRUE(is[k] == was[k] || std::ldexp(was[k], 8) != std::round(std::ldexp(was[k], 8))) << was[k];
      }
    }
  }
}

TEST(PackedGltf, RoundsDirectionsAndColoursToWhatTheirBitsHold) {
  SurfaceMesh mesh = ball(9);
  Attribute normals{
      .name = "normal", .meaning = AttributeMeaning::normal, .type = ScalarType::float32, .components = 3};
  Attribute colors{
      .name = "color", .meaning = AttributeMeaning::color, .type = ScalarType::float32, .components = 3};
  colors.colorSpace = ColorSpace::linear;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> fraction(0, 1);
  for (const Vec3& p : mesh.positions) {
    normals.append(std::array{p.x, p.y, p.z});
    colors.append(std::array{fraction(random), fraction(random), fraction(random)});
  }
  mesh.vertexAttributes = {normals, colors};
  const Packed file = packed(mesh, 14);
  EXPECT_TRUE(file.hasLost("normals finer than 8 bits"));
  EXPECT_TRUE(file.hasLost("colours finer than 8"));
  const auto find = [&](AttributeMeaning meaning) -> const Attribute& {
    return *std::ranges::find(file.file.mesh.vertexAttributes, meaning, &Attribute::meaning);
  };
  ASSERT_EQ(file.file.mesh.vertexAttributes.size(), 2u);
  const Attribute& readNormals = find(AttributeMeaning::normal);
  const double unit = readNormals.type == ScalarType::int8 ? 127 : 1;
  double farthest = 0;
  std::set<double> levels;
  for (std::size_t v = 0; v < file.file.mesh.positions.size(); ++v) {
    const Vec3& p = file.file.mesh.positions[v];
    const std::vector<double> n = readNormals.numbers(v);
    EXPECT_LE(std::hypot(n[0] / unit - p.x, n[1] / unit - p.y, n[2] / unit - p.z), 0.02) << "about a degree";
    for (const double c : colorFractions(find(AttributeMeaning::color), v)) {
      levels.insert(c);
      farthest = std::max(farthest, std::abs(c * 255 - std::round(c * 255)));
    }
  }
  EXPECT_GT(levels.size(), 100u);
  EXPECT_LE(farthest, 1e-3);
}

TEST(PackedGltf, StatesErrorsThatTheGridMakesLarger) {
  SurfaceMesh mesh = square();
  const std::vector<float> errors = {0.5F, 0.25F};
  const Written plain(mesh, {.triangleErrors = errors});
  EXPECT_EQ(std::ranges::max(plain.numbersOf("_ERROR")), 0.5);
  // The steepest triangle of the square rises by sqrt(1 + 4) a unit.
  for (const int bits : {4, 10}) {
    TemporaryFolder folder;
    MeshWriteOptions options{.triangleErrors = errors};
    options.packing = MeshPacking{.positionBits = bits};
    ASSERT_TRUE(writeMesh(mesh, folder.file("a.glb"), options));
    const std::string glb = bytesOf(folder.file("a.glb"));
    const Json json = jsonOf(glb);
    EXPECT_EQ(json["nodes"][0]["name"], "terrain");
    std::uint32_t length = 0;
    std::memcpy(&length, glb.data() + 12, sizeof length);
    const auto accessor = json["meshes"][0]["primitives"][0]["attributes"]["_ERROR"].get<std::size_t>();
    const Json view = json["bufferViews"][json["accessors"][accessor]["bufferView"].get<std::size_t>()];
    const Json stream = view["extensions"]["EXT_meshopt_compression"];
    const auto decoded =
        decodeMeshopt(std::string_view(glb).substr(28 + length + stream["byteOffset"].get<std::size_t>(),
                                                   stream["byteLength"].get<std::size_t>()),
                      4, 4, "ATTRIBUTES", "");
    ASSERT_TRUE(decoded) << decoded.error().describe();
    std::array<float, 4> grown{};
    std::memcpy(grown.data(), decoded->data(), sizeof grown);
    const double more = 3.0 / ((1 << bits) - 1) / 2 * (1 + std::sqrt(2.0) * std::sqrt(5.0));
    EXPECT_NEAR(std::ranges::max(grown), 0.5 + more, 1e-6);
    EXPECT_NEAR(std::ranges::min(grown), 0.25 + more, 1e-6);
  }
}

TEST(PackedGltf, IsSmall) {
  const SurfaceMesh mesh = ball(40);
  const Packed file = packed(mesh, 14);
  EXPECT_LT(file.bytes, 7 * mesh.positions.size());
}

TEST(PackedGltf, HoldsNothingOrOnePoint) {
  SurfaceMesh point;
  point.positions = {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}};
  point.triangles = {{0, 1, 2}};
  const Packed file = packed(point, 14);
  ASSERT_FALSE(file.file.mesh.positions.empty());
  EXPECT_EQ(file.file.mesh.positions[0], (Vec3{1, 2, 3}));
  TemporaryFolder folder;
  MeshWriteOptions options{.up = MeshUp::y};
  options.packing = MeshPacking{};
  EXPECT_TRUE(writeMesh(SurfaceMesh{}, folder.file("none.glb"), options));
}

TEST(PackedGltf, IsRefusedOfOtherFormatsAndOtherBits) {
  TemporaryFolder folder;
  MeshWriteOptions options{.up = MeshUp::y};
  options.packing = MeshPacking{.positionBits = 17};
  const auto many = writeMesh(square(), folder.file("a.glb"), options);
  ASSERT_FALSE(many);
  EXPECT_EQ(many.error().code, ErrorCode::usage);
  options.packing = MeshPacking{};
  const auto other = writeMesh(square(), folder.file("a.ply"), options);
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().culprit, "packed");
}

}  // namespace
}  // namespace arete
