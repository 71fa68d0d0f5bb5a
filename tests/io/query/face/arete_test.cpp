// SPDX-License-Identifier: GPL-3.0-or-later
//
// The face of the library: what a program of a few lines does, for both kinds of model, held against the
// rooms that do the work.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "engine/cut/cut.h"
#include "io/amt_fixture.h"
#include "io/formats/exchange/mesh_formats.h"
#include "io/geo/dem/raster_writer.h"
#include "io/query/extract/extract.h"
#include "io/query/face/arete.h"
#include "measure/mesh_distance.h"
#include "surface/front/front.h"

namespace arete {
namespace {

namespace fs = std::filesystem;

class Face : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "arete-face-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// A DEM of 40 by 30 metres, each a sample.
  Model terrain() {
    RasterHeightfield field = test::hills(40, 30, [](double z) { return std::round(z); });
    field.georeference.hasGeoTransform = true;
    field.georeference.geoTransform = {0, 1, 0, 0, 0, 1};
    field.georeference.verticalUnit = "metre";
    EXPECT_TRUE(writeGeoTiff(path("dem.tif"), field.columns, field.rows, field.heights, field.georeference));
    auto built = build(path("dem.tif"));
    EXPECT_TRUE(built) << built.error().describe();
    return std::move(*built);
  }
  /// A wave of 20 by 20 quads.
  Model surface() {
    MeshFile file;
    TriangleMesh mesh;
    for (int y = 0; y <= 20; ++y)
      for (int x = 0; x <= 20; ++x)
        mesh.positions.push_back({x / 20.0, y / 20.0, 0.1 * std::sin(x / 3.0) * std::cos(y / 4.0)});
    for (std::uint32_t y = 0; y < 20; ++y)
      for (std::uint32_t x = 0; x < 20; ++x) {
        const std::uint32_t a = 21 * y + x;
        mesh.triangles.push_back({a, a + 1, a + 22});
        mesh.triangles.push_back({a, a + 22, a + 21});
      }
    EXPECT_TRUE(writeMesh(mesh, path("wave.ply")));
    auto built = build(path("wave.ply"));
    EXPECT_TRUE(built) << built.error().describe();
    return std::move(*built);
  }

  fs::path folder_;
};

TEST_F(Face, BuildsWritesOpensAndCutsBothKinds) {
  for (const bool isTerrain : {true, false}) {
    const Model built = isTerrain ? terrain() : surface();
    ASSERT_EQ(std::holds_alternative<TerrainModel>(built), isTerrain);
    ASSERT_TRUE(write(built, path("m.amt")));
    const auto opened = open(path("m.amt"));
    ASSERT_TRUE(opened) << opened.error().describe();
    ASSERT_EQ(opened->index(), built.index());
    const double error = 0.02 * wholesOf(built).length;
    ASSERT_GT(error, 0);
    const auto tin = cut(*opened, {.maxError = error});
    ASSERT_TRUE(tin) << tin.error().describe();
    EXPECT_LE(tin->error, error);
    EXPECT_TRUE(tin->isComplete);
    EXPECT_EQ(tin->errors.size(), tin->mesh.triangles.size());
    EXPECT_LT(tin->mesh.triangles.size(), wholesOf(built).triangles);
    const auto few = cut(*opened, {.maxTriangles = 100});
    ASSERT_TRUE(few) << few.error().describe();
    EXPECT_LE(few->mesh.triangles.size(), 100u);
    EXPECT_GT(few->mesh.triangles.size(), 80u);

    const auto lost = write(*tin, path("tin.ply"));
    ASSERT_TRUE(lost) << lost.error().describe();
    const auto read = readMesh(path("tin.ply"));
    ASSERT_TRUE(read);
    EXPECT_EQ(read->mesh.triangles.size(), tin->mesh.triangles.size());
    EXPECT_EQ(read->verticalUnit, isTerrain ? "metre" : "");
    EXPECT_EQ(read->triangleErrors, tin->errors);
  }
}

TEST_F(Face, WritesTheMeshThatExtractWrites) {
  for (const bool isTerrain : {true, false}) {
    const Model model = isTerrain ? terrain() : surface();
    ExtractRequest request;
    request.criterion.maxError = 0.03 * wholesOf(model).length;
    request.output = path("by_extract.ply");
    const auto report = extract(model, request);
    ASSERT_TRUE(report) << report.error().describe();
    const auto tin = cut(model, request.criterion);
    ASSERT_TRUE(tin);
    ASSERT_TRUE(write(*tin, path("by_face.ply")));
    const auto one = readMesh(path("by_extract.ply")), other = readMesh(path("by_face.ply"));
    ASSERT_TRUE(one && other);
    EXPECT_EQ(one->mesh.positions, other->mesh.positions);
    EXPECT_EQ(one->mesh.triangles, other->mesh.triangles);
    EXPECT_EQ(one->triangleErrors, other->triangleErrors);
  }
}

TEST_F(Face, AnswersHeightsAndLinesOfSightOfTerrainAndRefusesThemOfSurfaces) {
  const Model model = terrain();
  const auto& heights = std::get<TerrainModel>(model);
  const Vec2 p = heights.toSource({7, 9});
  const auto height = heightAt(model, p.x, p.y);
  ASSERT_TRUE(height && *height);
  const RasterHeightfield samples = heights.rasterSamples();
  EXPECT_EQ(**height, samples.heights[9 * 40 + 7]);
  EXPECT_FALSE(heightAt(model, -1000, -1000)->has_value());
  // From a hundred above all of it, every place is seen; from the ground through a hill it is not.
  const auto seen = lineOfSight(model, {p.x, p.y, 1000}, {p.x + 10, p.y + 5, 0.1});
  ASSERT_TRUE(seen) << seen.error().describe();
  EXPECT_EQ(toString(seen->sight.verdict), std::string("visible"));
  const auto nowhere = lineOfSight(model, {-1e5, 0, 1}, {p.x, p.y, 1});
  ASSERT_FALSE(nowhere);
  EXPECT_EQ(nowhere.error().culprit, "observer");
  const Model other = surface();
  EXPECT_EQ(heightAt(other, 0, 0).error().code, ErrorCode::unsupported);
  EXPECT_EQ(lineOfSight(other, {0, 0, 1}, {1, 1, 1}).error().code, ErrorCode::unsupported);
}

TEST_F(Face, RefusesWhatMakesNoSenseByTheNameOfTheField) {
  const Model model = surface();
  EXPECT_EQ(cut(model, {}).error().culprit, "maxError");
  EXPECT_EQ(cut(terrain(), {.maxTriangles = 1}).error().culprit, "maxTriangles");
  EXPECT_EQ(cut(model, {.maxError = 1, .outsideError = 0.5}).error().culprit, "outsideError");
  EXPECT_EQ(cut(model, {.maxTriangles = 500, .order = CutOrder::twoQueues}).error().culprit, "order");
  EXPECT_EQ(cut(model, {.maxError = 1, .dropParts = 100}).error().culprit, "dropParts");
  EXPECT_EQ(open(path("none.amt")).error().code, ErrorCode::notFound);
  EXPECT_FALSE(build(path("none.tif")));
  const auto tin = cut(model, {.maxError = 1});
  ASSERT_TRUE(tin);
  EXPECT_FALSE(write(*tin, path("tin.unknown")));
}

TEST_F(Face, ADeadlineThatIsOverLeavesTheCoarsestCut) {
  for (const bool isTerrain : {true, false}) {
    const Model model = isTerrain ? terrain() : surface();
    const auto tin = cut(model, {.maxError = 0, .deadlineMilliseconds = 1e-9});
    ASSERT_TRUE(tin) << tin.error().describe();
    EXPECT_FALSE(tin->isComplete);
    EXPECT_GT(tin->mesh.triangles.size(), 0u);
    EXPECT_TRUE(std::isfinite(tin->error));
  }
}

TEST_F(Face, AnExtractMeasuresAndCertifiesBothKinds) {
  for (const bool isTerrain : {true, false}) {
    const Model model = isTerrain ? terrain() : surface();
    ExtractRequest request;
    request.criterion.maxError = 0.03 * wholesOf(model).length;
    request.output = path("tin.ply");
    request.certificate = path("tin.json");
    const auto report = extract(model, request, {}, "m.amt");
    ASSERT_TRUE(report) << report.error().describe();
    EXPECT_TRUE(
        std::visit([](const auto& found) { return found.isKept && found.measured.has_value(); }, *report));
    EXPECT_TRUE(fs::exists(request.output) && fs::exists(request.certificate));
  }
}

}  // namespace
}  // namespace arete
