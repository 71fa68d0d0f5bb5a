// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/extract/tin.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "datasets/families.h"
#include "engine/criteria/criterion.h"
#include "io/formats/exchange/export_tin.h"
#include "io/formats/exchange/mesh_formats.h"
#include "io/geo/crs/names.h"
#include "io/geo/table/plan_point_reader.h"
#include "io/io_fixture.h"
#include "io/mesh_fixture.h"
#include "terrain/builder/build.h"

namespace arete {
namespace {

using test::TemporaryFolder;

Result<TerrainModel> modelOf(std::string_view name) {
  for (const RasterFamily& family : rasterFamilies())
    if (family.name == name) return build(family.make(30, 25, 2));
  return failure(ErrorCode::usage, "no such family");
}

TEST(ExportTin, IsCounterClockwiseOnTheMapWhicheverWayTheGridTurns) {
  for (const char* name : {"fractal", "rotated", "south up", "geographic", "nodata holes"}) {
    SCOPED_TRACE(name);
    const auto model = modelOf(name);
    ASSERT_TRUE(model) << model.error().describe();
    const auto cut = takeCut(model->mt, UniformError(2));
    ASSERT_TRUE(cut);
    const TinExport tin = exportTin(*model, *cut).value();
    ASSERT_EQ(tin.errors.size(), tin.mesh.triangles.size());
    ASSERT_TRUE(tin.mesh.validate());
    for (std::size_t t = 0; t < tin.errors.size(); ++t) {
      const auto& c = tin.mesh.triangles[t];
      const Vec3 a = tin.mesh.positions[c[0]], b = tin.mesh.positions[c[1]], d = tin.mesh.positions[c[2]];
      EXPECT_GT((b.x - a.x) * (d.y - a.y) - (b.y - a.y) * (d.x - a.x), 0);
      EXPECT_LE(tin.errors[t], 2);
    }
  }
}

/// Extracts with a certificate; what `arete measure` would find in the file must agree with it.
void expectKept(const TerrainModel& model, const std::string& extension, double maxError,
                CutFit fit = CutFit::none) {
  const TemporaryFolder folder;
  TinExtractor extractor(model, "m.amt");
  ExtractRequest request;
  request.criterion.maxError = maxError;
  request.criterion.fit = fit;
  request.output = folder.file("tin" + extension);
  request.certificate = folder.file("c.json");
  const Result<ExtractedTin> tin = extractor.extract(request);
  ASSERT_TRUE(tin) << tin.error().describe();
  const Result<MeshFile> file = readMesh(request.output);
  ASSERT_TRUE(file) << file.error().describe();
  const MeasureOptions options{.planRounding = {file->frame.rounding.x, file->frame.rounding.y}};
  const auto report = model.isRaster ? measure(file->mesh, model.rasterSamples(), options)
                                     : measure(file->mesh, model.pointSamples(), options);
  ASSERT_TRUE(report);
  EXPECT_EQ(keepsPromise(*report, maxError), tin->isKept);
  EXPECT_EQ(report->maxAbsError, tin->measured->maxAbsError);
  // Where rounding is small beside the tolerance the promise holds for what the file says.
  if (2 * tin->format.heightRounding < maxError || tin->format.heightRounding == 0) {
    EXPECT_TRUE(tin->isKept) << extension << " " << maxError << " " << tin->format.heightRounding;
  }
  const auto json = nlohmann::json::parse(test::bytesOf(request.certificate));
  const auto& format = json["format"];
  EXPECT_EQ(format["name"], meshFormatOf(request.output)->name);
  EXPECT_EQ(format.contains("origin"), file->frame.origin.has_value());
  EXPECT_EQ(format["rounding"][0], file->frame.rounding.x);
  EXPECT_EQ(format["heightRounding"], tin->format.heightRounding);
  const bool hasCrs = !model.georeference.crsWkt.empty();
  EXPECT_EQ(format["doesNotSay"].contains("crs"), hasCrs && file->crsWkt.empty());
  EXPECT_EQ(json["promise"]["kept"], tin->isKept);
  EXPECT_EQ(json.contains("fit"), fit != CutFit::none);
  EXPECT_EQ(tin->fit.has_value(), fit != CutFit::none);
  if (!tin->fit) return;
  EXPECT_EQ(json["criterion"]["fit"], fitName(fit));
  EXPECT_EQ(json["fit"]["trianglesBefore"], tin->fit->trianglesBefore);
  EXPECT_EQ(json["fit"]["errorBefore"], tin->fit->errorBefore);
  EXPECT_LE(tin->triangles, tin->fit->trianglesBefore);
  EXPECT_EQ(json["fit"]["meanBefore"], tin->fit->meanBefore);
  EXPECT_EQ(json["measured"]["error"]["mean"], report->meanError);
  EXPECT_LE(tin->storedError, maxError);
  if (fit != CutFit::unbiased) return;
  EXPECT_EQ(tin->triangles, tin->fit->trianglesBefore);
  EXPECT_LE(std::abs(report->meanError), 0.02 * maxError + tin->format.heightRounding);
}

TEST(ExtractTin, PutsEveryCutOfAModelAboutOneOrigin) {
  const auto model = build(rasterFamilies()[2].make(60, 50, 4));
  ASSERT_TRUE(model);
  const TemporaryFolder folder;
  for (const char* extension : {".stl", ".glb"}) {
    std::vector<Vec3> origins;
    for (const double maxError : {0.0, 3.0, 40.0}) {
      TinExtractor extractor(*model, "m.amt");
      ExtractRequest request;
      request.criterion.maxError = maxError;
      request.output = folder.file(std::string("tin") + extension);
      ASSERT_TRUE(extractor.extract(request));
      const auto file = readMesh(request.output);
      ASSERT_TRUE(file && file->frame.origin) << extension;
      origins.push_back(*file->frame.origin);
    }
    EXPECT_EQ(origins[0], origins[1]) << extension;
    EXPECT_EQ(origins[0], origins[2]) << extension;
  }
}

TEST(ExtractTin, KeepsThePromiseInEveryFormatOnEveryFamily) {
  for (const RasterFamily& family : rasterFamilies()) {
    const auto model = build(family.make(40, 33, 2));
    ASSERT_TRUE(model) << family.name;
    for (const MeshFormat& format : meshFormats())
      for (const double maxError : {0.0, 0.5, 7.0}) {
        SCOPED_TRACE(fmt::format("{} {} {}", family.name, format.name, maxError));
        expectKept(*model, std::string(format.extension), maxError);
      }
  }
}

TEST(ExtractTin, KeepsThePromiseInEveryFormatWithFittedHeights) {
  for (const RasterFamily& family : rasterFamilies()) {
    const auto model = build(family.make(40, 33, 2));
    ASSERT_TRUE(model) << family.name;
    for (const MeshFormat& format : meshFormats())
      for (const CutFit fit : {CutFit::triangles, CutFit::error, CutFit::unbiased}) {
        SCOPED_TRACE(fmt::format("{} {} {}", family.name, format.name, fitName(fit)));
        expectKept(*model, std::string(format.extension), 3, fit);
      }
  }
  for (const PointFamily& family : pointFamilies()) {
    const auto model = build(family.make(400, 2));
    ASSERT_TRUE(model) << family.name;
    for (const CutFit fit : {CutFit::triangles, CutFit::error, CutFit::unbiased}) {
      SCOPED_TRACE(fmt::format("{} {}", family.name, fitName(fit)));
      expectKept(*model, ".ply", 7, fit);
    }
  }
}

TEST(ExtractTin, WritesTheErrorsOfTheFittedSurface) {
  const auto model = build(rasterFamilies()[2].make(60, 50, 4));
  ASSERT_TRUE(model);
  const auto fitted = fitFewestTriangles(*model, {.maxError = 3});
  ASSERT_TRUE(fitted);
  const TinExport tin = exportTin(*model, *fitted).value();
  ASSERT_EQ(tin.errors.size(), fitted->errors.size());
  for (std::size_t t = 0; t < tin.errors.size(); ++t) {
    EXPECT_GE(double(tin.errors[t]), fitted->errors[t]);
    EXPECT_NEAR(tin.errors[t], fitted->errors[t], 1e-6 * fitted->errors[t]);
  }
  for (std::size_t v = 0; v < fitted->heights.size(); ++v)
    EXPECT_EQ(tin.mesh.positions[v].z, fitted->heights[v]);
}

TEST(ExtractTin, KeepsThePromiseInEveryFormatOnPoints) {
  for (const PointFamily& family : pointFamilies()) {
    const auto model = build(family.make(400, 2));
    ASSERT_TRUE(model) << family.name;
    for (const MeshFormat& format : meshFormats())
      for (const double maxError : {0.5, 7.0}) {
        SCOPED_TRACE(fmt::format("{} {} {}", family.name, format.name, maxError));
        expectKept(*model, std::string(format.extension), maxError);
      }
  }
}

TEST(CrsNames, OpenNoFileThatAFileNames) {
  const TemporaryFolder folder;
  const std::string path = folder.write("crs.prj", "EPSG:32611");
  EXPECT_EQ(crsName(path), "unknown");
  EXPECT_EQ(compareCrs(path, "EPSG:32611"), CrsAgreement::unknown);
}

TEST(CrsNames, AreShortAndCompareByPlace) {
  EXPECT_EQ(crsName(""), "none");
  EXPECT_EQ(crsName("EPSG:32611"), "WGS 84 / UTM zone 11N (EPSG:32611)");
  EXPECT_EQ(crsName("gibberish"), "unknown");
  EXPECT_EQ(compareCrs("EPSG:32611", "EPSG:32611"), CrsAgreement::same);
  EXPECT_EQ(compareCrs("EPSG:4326", "EPSG:4326+5773"), CrsAgreement::same);
  EXPECT_EQ(compareCrs("EPSG:32611", "EPSG:4326"), CrsAgreement::different);
  EXPECT_EQ(compareCrs("EPSG:32611", ""), CrsAgreement::unknown);
}

TEST(PlanPointReader, TakesTwoColumnsOrThree) {
  const TemporaryFolder folder;
  for (const char* text :
       {"x,y\n1,2\n3,4\n", "1 2\n3 4\n", "name;lon;lat\na;1;2\nb;3;4\n", "1,2,9\n3,4,9\n"}) {
    SCOPED_TRACE(text);
    const auto read = readPlanPoints(folder.write("p.csv", text), "EPSG:32611");
    ASSERT_TRUE(read) << read.error().describe();
    EXPECT_EQ(read->positions, (std::vector<Vec2>{{1, 2}, {3, 4}}));
  }
  EXPECT_EQ(readPlanPoints(folder.write("e.csv", "x,y\n"), "").error().code, ErrorCode::invalidData);
  EXPECT_EQ(readPlanPoints(folder.file("none.csv"), "").error().code, ErrorCode::notFound);
}

TEST(PlanPointReader, ReprojectsLayers) {
  const TemporaryFolder folder;
  const std::string path =
      folder.write("p.geojson", R"({"type":"MultiPoint","coordinates":[[-117,34],[-117,0]]})");
  const auto read = readPlanPoints(path, "EPSG:32611");
  ASSERT_TRUE(read) << read.error().describe();
  ASSERT_EQ(read->positions.size(), 2u);
  EXPECT_NEAR(read->positions[0].x, 500000, 1e-3);
  EXPECT_NEAR(read->positions[0].y, 3762155.85, 1);
  EXPECT_NEAR(read->positions[1].y, 0, 1e-3);
  EXPECT_EQ(readPlanPoints(path, "").error().code, ErrorCode::invalidData);
  EXPECT_EQ(readPlanPoints(path, "EPSG:4326")->positions[0], (Vec2{-117, 34}));
}

}  // namespace
}  // namespace arete
