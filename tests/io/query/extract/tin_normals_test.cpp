// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/extract/tin_normals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "datasets/families.h"
#include "engine/criteria/criterion.h"
#include "engine/cut/cut.h"
#include "io/formats/exchange/export_tin.h"
#include "io/formats/exchange/mesh_formats.h"
#include "io/io_fixture.h"
#include "io/mesh_fixture.h"
#include "io/query/extract/tin.h"
#include "surface/normals/smooth_corners.h"
#include "terrain/builder/build.h"

namespace arete {
namespace {

Vec3 asItIs(const Vec3& p) {
  return p;
}

Vec3 cornerNormalAt(const SurfaceMesh& mesh, std::size_t triangle, std::size_t corner) {
  const bool isOfWedges = mesh.hasWedges();
  const Attribute& normals = isOfWedges ? mesh.wedgeAttributes.at(0) : mesh.vertexAttributes.at(0);
  const std::vector<double> n =
      normals.numbers(isOfWedges ? mesh.wedges[triangle][corner] : mesh.triangles[triangle][corner]);
  return {n[0], n[1], n[2]};
}

RasterHeightfield metreRaster(std::uint32_t columns, std::uint32_t rows, double (*height)(double, double)) {
  RasterHeightfield field;
  field.columns = columns;
  field.rows = rows;
  field.georeference.geoTransform = {1000, 1, 0, 2000, 0, -1};
  field.georeference.hasGeoTransform = true;
  for (std::uint32_t r = 0; r < rows; ++r)
    for (std::uint32_t c = 0; c < columns; ++c) field.heights.push_back(height(c, r));
  return field;
}

/// The cut of a model with so many triangles, as a TIN.
TinExport coarseTin(const TerrainModel& model, std::uint64_t triangles) {
  const auto cut =
      takeCut(model.mt, UniformError(0),
              {.maxTriangles = std::max<std::uint64_t>(triangles, model.mt.rootTriangleCount())});
  EXPECT_TRUE(cut);
  return exportTin(model, *cut).value();
}

// The oracle is smoothCorners() of the finest mesh, which pairs half-edges and knows nothing of the model.
TEST(TinNormals, AreThoseOfTheFinestTriangles) {
  for (const char* name : {"fractal", "rotated", "south up", "nodata holes"})
    for (const double degrees : {180.0, 40.0}) {
      SCOPED_TRACE(testing::Message() << name << ", " << degrees);
      const auto family = std::ranges::find(rasterFamilies(), name, &RasterFamily::name);
      const auto model = build(family->make(30, 25, 2));
      ASSERT_TRUE(model);
      const TinExport finest = exportTin(*model, frontOfPrefix(model->mt, model->mt.nodeCount())).value();
      const CornerNormals truth = smoothCorners(finest.mesh, degrees);
      std::map<std::tuple<double, double>, std::vector<Vec3>> at;
      for (std::size_t t = 0; t < finest.mesh.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
          const Vec3& p = finest.mesh.positions[finest.mesh.triangles[t][k]];
          at[{p.x, p.y}].push_back(truth.normals[truth.normalOf[t][k]]);
        }
      const TinExport tin = coarseTin(*model, 60);
      ASSERT_LT(tin.mesh.triangles.size(), finest.mesh.triangles.size() / 2);
      const auto made = withNormals(tin.mesh, tin.vertexOf, *model, asItIs,
                                    {.kind = NormalsKind::smooth, .creaseAngleDegrees = degrees});
      ASSERT_TRUE(made) << made.error().describe();
      EXPECT_EQ(made->positions, tin.mesh.positions);
      ASSERT_TRUE(made->validate());
      for (std::size_t t = 0; t < made->triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
          const Vec3& p = made->positions[made->triangles[t][k]];
          const Vec3 n = cornerNormalAt(*made, t, k);
          double least = 1;
          for (const Vec3& other : at.at({p.x, p.y})) least = std::min(least, norm(n - other));
          EXPECT_LT(least, 1e-6) << p.x << " " << p.y;
        }
    }
}

TEST(TinNormals, OfAPlaneAreItsOwn) {
  const auto model = build(metreRaster(20, 15, [](double c, double r) { return 0.5 * c - 0.25 * (14 - r); }));
  ASSERT_TRUE(model);
  const TinExport tin = coarseTin(*model, 2);
  const auto made = withNormals(tin.mesh, tin.vertexOf, *model, asItIs,
                                {.kind = NormalsKind::smooth, .creaseAngleDegrees = 1});
  ASSERT_TRUE(made);
  EXPECT_FALSE(made->hasWedges());
  const Vec3 up{-0.5, 0.25, 1};
  for (std::size_t t = 0; t < made->triangles.size(); ++t)
    EXPECT_LT(norm(cornerNormalAt(*made, t, 0) - up / norm(up)), 1e-7);
}

TEST(TinNormals, AreHardBeyondTheAngleOnEachSideOfARidge) {
  // Slopes of 63.4 degrees to both sides of column 10.
  const auto model = build(metreRaster(21, 13, [](double c, double) { return 20 - 2 * std::abs(c - 10); }));
  ASSERT_TRUE(model);
  const auto cut = takeCut(model->mt, UniformError(1e-9));
  ASSERT_TRUE(cut);
  const TinExport tin = exportTin(*model, *cut).value();
  for (const double degrees : {126.0, 127.0}) {
    const auto made = withNormals(tin.mesh, tin.vertexOf, *model, asItIs,
                                  {.kind = NormalsKind::smooth, .creaseAngleDegrees = degrees});
    ASSERT_TRUE(made);
    EXPECT_EQ(made->hasWedges(), degrees < 126.8);
    for (std::size_t t = 0; t < made->triangles.size(); ++t) {
      double middle = 0;
      for (const std::uint32_t v : made->triangles[t]) middle += made->positions[v].x / 3;
      const Vec3 own{middle < 1010.5 ? -2 / std::sqrt(5) : 2 / std::sqrt(5), 0, 1 / std::sqrt(5)};
      for (std::size_t k = 0; k < 3; ++k) {
        const bool isOnRidge = made->positions[made->triangles[t][k]].x == 1010.5;
        const Vec3 n = cornerNormalAt(*made, t, k);
        if (isOnRidge && degrees > 126.8)
          EXPECT_LT(std::hypot(n.x, n.y), 0.2) << n.x << " " << n.y;
        else
          EXPECT_LT(norm(n - own), 1e-6);
      }
    }
  }
}

TEST(TinNormals, MeetWhereARasterGoesRoundTheEarth) {
  RasterHeightfield field = metreRaster(37, 9, [](double c, double r) {
    return 1e5 * std::sin(c * 2 * 3.14159265358979 / 36 + 1) * std::cos((r - 4) / 3);
  });
  for (std::uint32_t r = 0; r < 9; ++r) field.heights[field.index(36, r)] = field.at(0, r);
  field.georeference.geoTransform = {-185, 10, 0, 45, 0, -10};
  field.georeference.isGeographic = true;
  field.georeference.repeatsFirstColumn = true;
  const auto model = build(field);
  ASSERT_TRUE(model);
  const TinExport tin = coarseTin(*model, 1'000'000);
  const double unit = 3.14159265358979 / 180;
  const auto onSphere = [&](const Vec3& p) {
    const double radius = 6e6 + p.z;
    return Vec3{radius * std::cos(p.y * unit) * std::cos(p.x * unit),
                radius * std::cos(p.y * unit) * std::sin(p.x * unit), radius * std::sin(p.y * unit)};
  };
  const auto made = withNormals(tin.mesh, tin.vertexOf, *model, onSphere,
                                {.kind = NormalsKind::smooth, .creaseAngleDegrees = 180});
  ASSERT_TRUE(made);
  std::map<double, std::vector<Vec3>> atSeam;
  std::set<std::pair<double, double>> seen;
  for (std::size_t t = 0; t < made->triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& p = made->positions[made->triangles[t][k]];
      if ((p.x == -180 || p.x == 180) && seen.insert({p.x, p.y}).second)
        atSeam[p.y].push_back(cornerNormalAt(*made, t, k));
    }
  EXPECT_EQ(atSeam.size(), 9u);
  for (const auto& [y, normals] : atSeam) {
    ASSERT_EQ(normals.size(), 2u) << y;
    EXPECT_LT(norm(normals[0] - normals[1]), 1e-7) << y;
  }
}

/// The normals of the first primitive, as the bytes have them.
std::vector<Vec3> normalsOfGlb(const std::string& path) {
  const std::string bytes = test::bytesOf(path);
  const auto word = [&](std::size_t at) {
    std::uint32_t number = 0;
    std::memcpy(&number, bytes.data() + at, sizeof number);
    return number;
  };
  const std::size_t buffer = 20 + word(12) + 8;
  const auto document = nlohmann::json::parse(bytes.substr(20, word(12)));
  const auto& accessor =
      document["accessors"]
              [document["meshes"][0]["primitives"][0]["attributes"]["NORMAL"].get<std::size_t>()];
  const auto& view = document["bufferViews"][accessor["bufferView"].get<std::size_t>()];
  const std::size_t start = buffer + view.value("byteOffset", 0u) + accessor.value("byteOffset", 0u);
  std::vector<Vec3> normals;
  for (std::size_t i = 0; i < accessor["count"].get<std::size_t>(); ++i) {
    std::array<float, 3> n{};
    std::memcpy(n.data(), bytes.data() + start + 12 * i, sizeof n);
    normals.push_back({n[0], n[1], n[2]});
  }
  return normals;
}

std::vector<Vec3> normalsOfFile(const std::string& path) {
  const auto file = readMesh(path);
  std::vector<Vec3> normals;
  if (!file) return normals;
  for (const auto* attributes : {&file->mesh.vertexAttributes, &file->mesh.wedgeAttributes})
    for (const Attribute& a : *attributes)
      for (std::size_t i = 0; a.name == kNormalName && i < a.elementCount(); ++i) {
        const std::vector<double> n = a.numbers(i);
        normals.push_back({n[0], n[1], n[2]});
      }
  return normals;
}

TEST(TinNormals, OfAFileBelongToTheLengthsOfItsFormat) {
  RasterHeightfield field =
      metreRaster(20, 15, [](double c, double r) { return 3 * (0.5 * c - 0.25 * (14 - r)); });
  field.georeference.verticalUnitMetres = 1.0 / 3;
  const auto model = build(field);
  ASSERT_TRUE(model);
  const test::TemporaryFolder folder;
  // A glTF has metres on every axis; other formats have the numbers of the DEM, which are three times as
  // steep.
  for (const auto& [name, scale] :
       {std::pair("tin.glb", 1.0), std::pair("tin.obj", 3.0), std::pair("tin.ply", 3.0)}) {
    SCOPED_TRACE(name);
    TinExtractor extractor(*model, "m.amt");
    ExtractRequest request;
    request.criterion.maxError = 0.5;
    request.output = folder.file(name);
    request.normals = {.kind = NormalsKind::smooth, .creaseAngleDegrees = 180};
    const auto tin = extractor.extract(request);
    ASSERT_TRUE(tin) << tin.error().describe();
    const Vec3 up{-0.5 * scale, 0.25 * scale, 1}, n = up / norm(up);
    const bool isGltf = std::string_view(name).starts_with("tin.gl");
    const std::vector<Vec3> normals = isGltf ? normalsOfGlb(request.output) : normalsOfFile(request.output);
    EXPECT_FALSE(normals.empty());
    for (const Vec3& other : normals)
      EXPECT_LT(norm(other - (isGltf ? Vec3{n.x, n.z, -n.y} : n)), 1e-6) << other.x << " " << other.y;
  }
}

TEST(TinNormals, AreRefusedWhereTheyHaveNoMeaning) {
  const auto projected = build(rasterFamilies()[0].make(10, 8, 1));
  ASSERT_TRUE(projected);
  const auto geographic = std::ranges::find(rasterFamilies(), "geographic", &RasterFamily::name);
  const auto degrees = build(geographic->make(10, 8, 1));
  ASSERT_TRUE(degrees);
  const test::TemporaryFolder folder;
  const auto outcome = [&](const TerrainModel& model, const std::string& name, bool isMetric) {
    TinExtractor extractor(model, "m.amt");
    ExtractRequest request;
    request.criterion.maxError = 1;
    request.output = folder.file(name);
    request.place.isMetric = isMetric;
    request.normals.kind = NormalsKind::smooth;
    const auto made = extractor.extract(request);
    return made ? std::string() : made.error().culprit;
  };
  EXPECT_EQ(outcome(*projected, "a.tif", false), "normals");
  EXPECT_EQ(outcome(*projected, "a.obj", true), "normals");
  EXPECT_EQ(outcome(*degrees, "b.obj", false), "normals");
  EXPECT_EQ(outcome(*degrees, "b.glb", false), "");
  EXPECT_EQ(outcome(*projected, "a.obj", false), "");
}

}  // namespace
}  // namespace arete
