// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/glb/levels/join_levels.h"

#include <gtest/gtest.h>

#include <numbers>

#include "io/formats/exchange/mesh_formats.h"
#include "io/written_glb.h"

namespace arete {
namespace {

using namespace test;

SurfaceMesh strip(std::uint32_t squares) {
  SurfaceMesh mesh;
  for (std::uint32_t i = 0; i <= squares; ++i) {
    mesh.positions.push_back({double(i), 0, 0});
    mesh.positions.push_back({double(i), 1, double(i % 3)});
    if (i == 0) continue;
    mesh.triangles.push_back({2 * i - 2, 2 * i, 2 * i - 1});
    mesh.triangles.push_back({2 * i - 1, 2 * i, 2 * i + 1});
  }
  mesh.materials.resize(1);
  mesh.materials[0].name = "paint";
  mesh.materialOf.assign(mesh.triangles.size(), 0);
  return mesh;
}

TEST(JoinGltfLevels, ShowsTheFinestAndNamesTheOthersFromFineToCoarse) {
  for (const bool isPacked : {false, true}) {
    SCOPED_TRACE(isPacked);
    TemporaryFolder folder;
    std::vector<GltfLevel> levels;
    for (const std::uint32_t squares : {2u, 9u, 5u}) {
      MeshWriteOptions options{.up = MeshUp::y};
      if (isPacked) options.packing = MeshPacking{};
      const std::string file = folder.file(std::to_string(squares) + ".glb");
      ASSERT_TRUE(writeMesh(strip(squares), file, options));
      levels.push_back({file, 1.0 / squares, 2 * squares});
    }
    const std::string path = folder.file("all.glb");
    ASSERT_TRUE(joinGltfLevels(levels, path, false));
    const Json json = jsonOf(bytesOf(path));
    ASSERT_EQ(json["scenes"][0]["nodes"].size(), 1u);
    const Json& shown = json["nodes"][json["scenes"][0]["nodes"][0].get<std::size_t>()];
    EXPECT_EQ(shown["extras"]["arete"]["triangles"], 18);
    const Json& ids = shown["extensions"]["MSFT_lod"]["ids"];
    ASSERT_EQ(ids.size(), 2u);
    EXPECT_EQ(json["nodes"][ids[0].get<std::size_t>()]["extras"]["arete"]["triangles"], 10);
    EXPECT_EQ(json["nodes"][ids[1].get<std::size_t>()]["extras"]["arete"]["error"], 0.5);
    // The box is 9 by 1 by 2: an error of a fifth is a pixel where it covers 5 sqrt(86) pixels.
    const Json& coverage = shown["extras"]["MSFT_screencoverage"];
    ASSERT_EQ(coverage.size(), 3u);
    const double aPixel = std::numbers::pi / 4 * 86 / (1920.0 * 1080.0);
    EXPECT_NEAR(coverage[0].get<double>(), 25 * aPixel, 1e-3 * 25 * aPixel);
    EXPECT_NEAR(coverage[1].get<double>(), 4 * aPixel, 1e-3 * 4 * aPixel);
    EXPECT_EQ(coverage[2], 0);
    EXPECT_EQ(json["materials"].size(), 1u) << "which all levels have";
    EXPECT_FALSE(json.contains("extensionsRequired") &&
                 json["extensionsRequired"].dump().find("MSFT_lod") != std::string::npos);
    const Result<MeshFile> file = readMesh(path);
    ASSERT_TRUE(file) << file.error().describe();
    EXPECT_EQ(file->mesh.triangles.size(), 18u);
    EXPECT_EQ(file->mesh.materials.at(0).name, "paint");
    const Result<MeshFile> alone = readMesh(folder.file("9.glb"));
    ASSERT_TRUE(alone);
    EXPECT_EQ(file->mesh.positions, alone->mesh.positions);
    EXPECT_EQ(file->mesh.triangles, alone->mesh.triangles);
    // As if another level were shown, from the same bytes.
    std::string other = bytesOf(path);
    Json changed = json;
    changed["scenes"][0]["nodes"] = {ids[1]};
    const std::string before = "\"nodes\":[" + json["scenes"][0]["nodes"][0].dump() + "]}]",
                      after = "\"nodes\":[" + ids[1].dump() + "]}]";
    ASSERT_GE(before.size(), after.size());
    const std::size_t at = other.find("\"scenes\":[{" + before);
    ASSERT_NE(at, std::string::npos);
    other.replace(at + 11, before.size(), after + std::string(before.size() - after.size(), ' '));
    std::ofstream(folder.file("other.glb"), std::ios::binary) << other;
    const Result<MeshFile> coarse = readMesh(folder.file("other.glb"));
    ASSERT_TRUE(coarse) << coarse.error().describe();
    const Result<MeshFile> coarseAlone = readMesh(folder.file("2.glb"));
    EXPECT_EQ(coarse->mesh.positions, coarseAlone->mesh.positions);
  }
}

TEST(JoinGltfLevels, NamesALevelThatIsNoGlb) {
  TemporaryFolder folder;
  std::ofstream(folder.file("a.glb")) << "no";
  const Status joined = joinGltfLevels({{folder.file("a.glb"), 0, 1}}, folder.file("b.glb"), false);
  ASSERT_FALSE(joined);
  EXPECT_EQ(joined.error().culprit, folder.file("a.glb"));
}

}  // namespace
}  // namespace arete
