// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every kind of file as a model: what it becomes, and that nothing is written.
#include "io/query/source/any_model.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "datasets/families.h"
#include "io/formats/exchange/mesh_formats.h"
#include "io/query/face/arete.h"
#include "io/written_amt.h"
#include "surface/front/front.h"
#include "terrain/builder/build.h"

namespace arete {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;

void put(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

constexpr const char* kHill =
    "v 0 0 1\nv 10 0 2\nv 10 10 3\nv 0 10 4\nv 5 5 9\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";

std::string grid(double cell, const char* nodata = "-9999") {
  return fmt::format(
      "ncols 4\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize {}\nNODATA_value {}\n1 2 3 4\n2 9 4 -9999\n3 4 5 "
      "6\n",
      cell, nodata);
}

const TerrainModel& terrainOf(const Result<AnyModel>& opened) {
  EXPECT_TRUE(opened) << opened.error().describe();
  return std::get<TerrainModel>(opened->model);
}

TEST(AnyModel, ADemIsTerrainAndAMeshWithFacesIsASurfaceAndWhatHasNeitherIsPoints) {
  const TemporaryFolder folder;
  put(folder.file("dem.asc"), grid(10));
  put(folder.file("hill.obj"), kHill);
  put(folder.file("points.csv"), "x,y,z\n0,0,1\n10,0,2\n10,10,3\n0,10,4\n5,5,9\n");
  put(folder.file("cloud.obj"), "v 0 0 1\nv 10 0 2\nv 10 10 3\nv 0 10 4\nv 5 5 9\n");
  const auto dem = openAnyModel(folder.file("dem.asc"));
  EXPECT_TRUE(terrainOf(dem).isRaster);
  EXPECT_EQ(terrainOf(dem).mt.vertexCount(), 11u) << "the void is no vertex";
  EXPECT_TRUE(dem->isBuilt);
  const auto hill = openAnyModel(folder.file("hill.obj"));
  ASSERT_TRUE(hill) << hill.error().describe();
  EXPECT_TRUE(std::holds_alternative<SurfaceModel>(hill->model));
  for (const char* name : {"points.csv", "cloud.obj"}) {
    const auto points = openAnyModel(folder.file(name));
    EXPECT_FALSE(terrainOf(points).isRaster) << name;
    EXPECT_EQ(terrainOf(points).mt.vertexCount(), 5u) << name;
  }
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(fs::path(folder.file("x")).parent_path()))
    names.insert(entry.path().filename());
  EXPECT_EQ(names, (std::set<std::string>{"dem.asc", "hill.obj", "points.csv", "cloud.obj"}))
      << "no file is written";
}

TEST(AnyModel, AFileThatIsAModelIsOpenedWhateverItsName) {
  const TemporaryFolder folder;
  const std::string path = test::writtenTo(folder, false, true, 30, 20);
  fs::copy(path, folder.file("model.dat"));
  for (const std::string& name : {path, folder.file("model.dat")}) {
    const auto opened = openAnyModel(name);
    EXPECT_EQ(terrainOf(opened).mt.vertexCount(), terrainOf(openAnyModel(path)).mt.vertexCount());
    EXPECT_FALSE(opened->isBuilt);
    EXPECT_TRUE(isModelFile(name));
  }
  put(folder.file("not.amt"), "no model");
  const auto wrong = openAnyModel(folder.file("not.amt"));
  ASSERT_FALSE(wrong) << "a name that promises a model is held to it";
  EXPECT_NE(wrong.error().culprit.find("not.amt"), std::string::npos);
}

TEST(AnyModel, ATinThatWasExtractedKeepsItsTriangles) {
  const TemporaryFolder folder;
  std::uint64_t seed = 500;
  for (const RasterFamily& family : rasterFamilies()) {
    auto model = build(family.make(23, 17, ++seed));
    ASSERT_TRUE(model);
    const auto tin = cut(*model, {.maxError = 0.3});
    ASSERT_TRUE(tin) << family.name << ": " << tin.error().describe();
    for (const char* extension : {"ply", "obj", "2dm", "gpkg"}) {
      // A database takes longer, and differs in nothing from family to family.
      if (std::string(extension) == "gpkg" && seed > 502) continue;
      const std::string path = folder.file(std::string("tin.") + extension);
      ASSERT_TRUE(write(*tin, path));
      const auto opened = openAnyModel(path);
      ASSERT_TRUE(opened) << family.name << ", " << extension << ": " << opened.error().describe();
      const auto* const surface = std::get_if<SurfaceModel>(&opened->model);
      ASSERT_TRUE(surface) << family.name;
      // Every triangle by the positions of its corners, in any order.
      const auto trianglesOf = [](const SurfaceMesh& mesh) {
        std::multiset<std::multiset<std::string>> all;
        for (const auto& t : mesh.triangles) {
          std::multiset<std::string> corners;
          for (const auto v : t) {
            const Vec3 p = mesh.positions[std::size_t(v)];
            corners.insert(fmt::format("{} {} {}", p.x, p.y, p.z));
          }
          all.insert(std::move(corners));
        }
        return all;
      };
      EXPECT_EQ(trianglesOf(finestSurfaceOf(*surface).mesh), trianglesOf(tin->mesh))
          << family.name << ", seed " << seed << ", " << extension;
    }
  }
}

TEST(AnyModel, ATinInDegreesIsSaidToBeAWall) {
  const TemporaryFolder folder;
  RasterHeightfield field = rasterFamilies()[2].make(12, 10, 3);
  field.georeference.geoTransform = {10, 0.001, 0, 60, 0, -0.001};
  field.georeference.hasGeoTransform = field.georeference.isGeographic = true;
  field.georeference.crsWkt = "EPSG:4326";
  auto model = build(field);
  ASSERT_TRUE(model);
  const auto tin = cut(*model, {.maxError = 1});
  ASSERT_TRUE(tin);
  ASSERT_TRUE(write(*tin, folder.file("tin.ply")));
  const auto opened = openAnyModel(folder.file("tin.ply"));
  ASSERT_TRUE(opened) << opened.error().describe();
  ASSERT_EQ(opened->warnings.size(), 1u);
  EXPECT_NE(opened->warnings[0].sentence.find("a wall"), std::string::npos) << opened->warnings[0].sentence;
}

TEST(AnyModel, AGltfInMetresOfADemInDegreesIsASurfaceInThoseMetres) {
  const TemporaryFolder folder;
  RasterHeightfield field = rasterFamilies()[2].make(12, 10, 3);
  field.georeference.geoTransform = {10, 0.001, 0, 60, 0, -0.001};
  field.georeference.hasGeoTransform = field.georeference.isGeographic = true;
  field.georeference.crsWkt = "EPSG:4326";
  auto model = build(field);
  ASSERT_TRUE(model);
  const auto tin = cut(*model, {.maxError = 0});
  ASSERT_TRUE(tin);
  for (const char* name : {"tin.glb", "tin.gltf"}) {
    ASSERT_TRUE(write(*tin, folder.file(name)));
    const auto opened = openAnyModel(folder.file(name));
    ASSERT_TRUE(opened) << opened.error().describe();
    const auto* const surface = std::get_if<SurfaceModel>(&opened->model);
    ASSERT_TRUE(surface);
    EXPECT_TRUE(surface->crsWkt.empty());
    ASSERT_EQ(opened->warnings.size(), 1u);
    EXPECT_NE(opened->warnings[0].sentence.find("metres to the east"), std::string::npos);
    Vec3 low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
    for (const Vec3& p : finestSurfaceOf(*surface).mesh.positions) {
      EXPECT_NEAR(p.x, double(float(p.x)), 1e-9);
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    // Eleven and nine cells: 55.8 m to the east and 111.4 m to the north each, at 60 degrees.
    EXPECT_NEAR(high.x - low.x, 11 * 55.8, 2) << name;
    EXPECT_NEAR(high.y - low.y, 9 * 111.4, 2) << name;
  }
}

TEST(AnyModel, IsWhatTheReaderAndTheBuilderMakeOfTheFile) {
  const TemporaryFolder folder;
  put(folder.file("dem.asc"), grid(10));
  const auto opened = openAnyModel(folder.file("dem.asc"));
  const auto face = build(folder.file("dem.asc"));
  ASSERT_TRUE(face);
  const auto& other = std::get<TerrainModel>(*face);
  EXPECT_EQ(terrainOf(opened).sourceChecksum, other.sourceChecksum);
  EXPECT_EQ(terrainOf(opened).mt.triangleCount(), other.mt.triangleCount());
}

TEST(AnyModel, AnswersWhatCannotBeBuiltWithTheFileAndTheReason) {
  const TemporaryFolder folder;
  put(folder.file("text.txt"), "a letter to a friend\n");
  put(folder.file("empty.tif"), "");
  put(folder.file("flat.csv"), "x,y,z\n0,0,1\n1,1,1\n2,2,1\n");
  for (const char* name :
       {"text.txt", "empty.tif", "flat.csv", "missing.tif", "missing.obj", "missing.amt"}) {
    const auto opened = openAnyModel(folder.file(name));
    ASSERT_FALSE(opened) << name;
    EXPECT_NE(opened.error().describe().find(name), std::string::npos) << opened.error().describe();
    EXPECT_EQ(opened.error().describe().find("--"), std::string::npos) << opened.error().describe();
  }
}

TEST(AnyModel, AKindSaysWhatTheFileDoesNotAndIsRefusedWhereItContradicts) {
  const TemporaryFolder folder;
  put(folder.file("hill.obj"), kHill);
  put(folder.file("dem.asc"), grid(10));
  EXPECT_EQ(terrainOf(openAnyModel(folder.file("hill.obj"), {.kind = "terrain"})).mt.vertexCount(), 5u);
  const auto wrong = openAnyModel(folder.file("dem.asc"), {.kind = "surface"});
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().code, ErrorCode::usage);
  EXPECT_EQ(wrong.error().culprit, "kind surface");
}

TEST(AnyModel, ReportsItsProgressAndEndsWhenItIsCancelled) {
  const TemporaryFolder folder;
  std::string points = "x,y,z\n";
  for (int i = 0; i < 3000; ++i)
    points += fmt::format("{},{},{}\n", i % 61 + 0.3 * std::sin(i), i / 61 + 0.3 * std::cos(i), std::sin(i));
  put(folder.file("points.csv"), points);
  std::set<std::string> stages;
  RunContext context;
  context.progress = [&](std::string_view stage, double fraction) {
    stages.emplace(stage);
    EXPECT_GE(fraction, 0);
    EXPECT_LE(fraction, 1);
  };
  ASSERT_TRUE(openAnyModel(folder.file("points.csv"), {}, context));
  EXPECT_GE(stages.size(), 1u);
  const std::atomic<bool> cancelled = true;
  context.cancel = &cancelled;
  const auto ended = openAnyModel(folder.file("points.csv"), {}, context);
  ASSERT_FALSE(ended);
  EXPECT_EQ(ended.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace arete
