// SPDX-License-Identifier: GPL-3.0-or-later
//
// TINs of DEMs in degrees are extracted in metres and in other CRSs, read back from their files, and measured
// twice: by measureElsewhere() and by a checker that shares nothing with it or with what led them there. It
// asks PROJ itself where a sample is, or takes its place and its vertical from the formula of the ellipsoid,
// and tries every triangle.
#include "io/query/placed/measure_placed.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <proj.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/formats/exchange/mesh_formats.h"
#include "io/geo/bent/place_map.h"
#include "io/io_fixture.h"
#include "io/query/extract/tin.h"
#include "terrain/builder/build.h"

namespace arete {
namespace {

using test::TemporaryFolder;

struct DegreesDem {
  std::string name;
  double west, north, stepX, stepY;
  std::uint32_t columns, rows;
  std::string crs;  ///< a target beside metres
  bool isClosed = false;
};

// Steps are coarse, so that bending matters in DEMs that are small enough to try every triangle.
const std::vector<DegreesDem> kDems = {
    {"alps", 7, 47, 0.05, 0.05, 19, 15, "utm"},
    {"dateline", 178.02, -16, 0.1, 0.1, 21, 15, "utm"},
    {"svalbard", 10.2, 79.5, 0.3, 0.1, 17, 15, "utm"},
    {"north pole", -180, 90, 20, 0.05, 19, 9, "EPSG:3413", true},
    {"antarctica", 0, -88, 20, 0.15, 19, 9, "EPSG:3031", true},
};

RasterHeightfield fieldOf(const DegreesDem& dem) {
  RasterHeightfield field;
  field.columns = dem.columns;
  field.rows = dem.rows;
  field.georeference = georeferenceOf("EPSG:4326", "m").value();
  field.georeference.hasGeoTransform = true;
  field.georeference.repeatsFirstColumn = dem.isClosed;
  field.georeference.geoTransform = {dem.west - dem.stepX / 2,  dem.stepX, 0,
                                     dem.north + dem.stepY / 2, 0,         -dem.stepY};
  for (std::uint32_t r = 0; r < dem.rows; ++r)
    for (std::uint32_t c = 0; c < dem.columns; ++c) {
      const std::uint32_t column = dem.isClosed && c + 1 == dem.columns ? 0 : c;
      const double slow = std::sin(0.31 * column + 1) * std::cos(0.23 * r),
                   quick = std::sin(1.7 * column * (r + 1.0));
      const bool isPole = dem.north - r * dem.stepY >= 90;
      field.heights.push_back(isPole ? 500 : std::round(600 + 500 * slow + 120 * quick));
    }
  field.source = dem.name + ".tif";
  field.sourceChecksum = heightsChecksum(field);
  return field;
}

/// A triangle as a sample sees it: level offsets from the sample, and heights.
using Seen = std::array<Vec3, 3>;

struct Checked {
  double largest = 0;
  std::size_t covered = 0, missed = 0;
};

/// The height of the triangle at the sample, if it is there; otherwise the distance to its nearest point.
struct Contact2 {
  bool holds = false;
  double height = 0, distance = 0;
};
Contact2 contactOf(const Seen& t) {
  const auto turn = [](const Vec3& p, const Vec3& q) { return p.x * q.y - p.y * q.x; };
  const double a = turn(t[1], t[2]), b = turn(t[2], t[0]), c = turn(t[0], t[1]), sum = a + b + c;
  if (sum != 0 && std::min({a / sum, b / sum, c / sum}) >= -1e-12)
    return {true, (a * t[0].z + b * t[1].z + c * t[2].z) / sum, 0};
  Contact2 nearest{false, 0, 1e300};
  for (int k = 0; k < 3; ++k) {
    const Vec3 &p = t[k], &q = t[(k + 1) % 3];
    const double dx = q.x - p.x, dy = q.y - p.y, square = dx * dx + dy * dy;
    const double s = square > 0 ? std::clamp(-(p.x * dx + p.y * dy) / square, 0.0, 1.0) : 0;
    const double far = std::hypot(p.x + s * dx, p.y + s * dy);
    if (far < nearest.distance) nearest = {false, p.z + s * (q.z - p.z), far};
  }
  return nearest;
}

/// @param see  the vertices as a sample sees them
Checked check(const TriangleMesh& mesh, const RasterHeightfield& field, double reach,
              const std::function<std::vector<Vec3>(Vec2 place)>& see) {
  Checked result;
  for (std::uint32_t r = 0; r < field.rows; ++r)
    for (std::uint32_t c = 0; c < field.columns; ++c) {
      const std::vector<Vec3> seen = see(field.georeference.toSource(c, r));
      std::optional<double> error;
      Contact2 nearest{false, 0, 1e300};
      for (const auto& t : mesh.triangles) {
        const Seen triangle = {seen[t[0]], seen[t[1]], seen[t[2]]};
        if (std::isnan(triangle[0].x + triangle[1].x + triangle[2].x)) continue;
        const Contact2 contact = contactOf(triangle);
        if (contact.holds)
          error = std::max(error.value_or(0), std::abs(contact.height - field.at(c, r)));
        else if (contact.distance < nearest.distance)
          nearest = contact;
      }
      if (!error && nearest.distance <= reach) error = std::abs(nearest.height - field.at(c, r));
      if (!error) {
        ++result.missed;
        continue;
      }
      ++result.covered;
      result.largest = std::max(result.largest, *error);
    }
  return result;
}

/// Metres: vertices in a basis of each sample whose third direction is the normal of the ellipsoid there.
Checked checkInMetres(const TriangleMesh& mesh, const RasterHeightfield& field, const Vec3& about,
                      double reach) {
  const auto ellipsoid = [](Vec2 place, double height) {
    const double a = 6378137, f = 1 / 298.257223563, e2 = f * (2 - f), degree = std::numbers::pi / 180;
    const double lat = place.y * degree, lon = place.x * degree;
    const double n = a / std::sqrt(1 - e2 * std::sin(lat) * std::sin(lat));
    return Vec3{(n + height) * std::cos(lat) * std::cos(lon), (n + height) * std::cos(lat) * std::sin(lon),
                (n * (1 - e2) + height) * std::sin(lat)};
  };
  const auto basis = [](Vec2 place) {
    const double degree = std::numbers::pi / 180, lat = place.y * degree, lon = place.x * degree;
    return std::array{Vec3{-std::sin(lon), std::cos(lon), 0},
                      Vec3{-std::sin(lat) * std::cos(lon), -std::sin(lat) * std::sin(lon), std::cos(lat)},
                      Vec3{std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)}};
  };
  const auto axes = basis({about.x, about.y});
  const Vec3 origin = ellipsoid({about.x, about.y}, about.z);
  std::vector<Vec3> geocentric;
  for (const Vec3& p : mesh.positions)
    geocentric.push_back(origin + p.x * axes[0] + p.y * axes[1] + p.z * axes[2]);
  return check(mesh, field, reach, [&](Vec2 place) {
    const auto [east, north, up] = basis(place);
    const Vec3 foot = ellipsoid(place, 0);
    std::vector<Vec3> seen;
    for (const Vec3& p : geocentric) {
      const Vec3 d = p - foot;
      // What is beyond a quarter of the Earth is not below the sample.
      const double behind = dot(d, up) < -3e6 ? std::nan("") : 0;
      seen.push_back({dot(d, east) + behind, dot(d, north), dot(d, up)});
    }
    return seen;
  });
}

Checked checkOnMap(const TriangleMesh& mesh, const RasterHeightfield& field, const std::string& crs,
                   double reach) {
  const std::unique_ptr<PJ_CONTEXT, decltype(&proj_context_destroy)> context(proj_context_create(),
                                                                             &proj_context_destroy);
  PJ* const plain = proj_create_crs_to_crs(context.get(), "EPSG:4326", crs.c_str(), nullptr);
  EXPECT_NE(plain, nullptr);
  PJ* const usual = proj_normalize_for_visualization(context.get(), plain);
  const Checked result = check(mesh, field, reach, [&](Vec2 place) {
    const PJ_COORD at = proj_trans(usual, PJ_FWD, proj_coord(place.x, place.y, 0, 0));
    std::vector<Vec3> seen;
    for (const Vec3& p : mesh.positions) seen.push_back({p.x - at.xy.x, p.y - at.xy.y, p.z});
    return seen;
  });
  proj_destroy(usual);
  proj_destroy(plain);
  return result;
}

void expectPromise(const DegreesDem& dem, const std::string& crs, double tolerance,
                   const std::string& extension) {
  SCOPED_TRACE(
      fmt::format("{} to {} at {} as {}", dem.name, crs.empty() ? "metres" : crs, tolerance, extension));
  const RasterHeightfield field = fieldOf(dem);
  const auto model = build(field);
  ASSERT_TRUE(model) << model.error().describe();
  const TemporaryFolder folder;
  ExtractRequest request;
  request.criterion.maxError = tolerance;
  request.output = folder.file("tin" + extension);
  request.certificate = folder.file("c.json");
  request.place = {.crs = crs, .isMetric = crs.empty()};
  TinExtractor extractor(*model, "m.amt");
  const auto tin = extractor.extract(request);
  ASSERT_TRUE(tin) << tin.error().describe();
  EXPECT_TRUE(tin->isKept);
  ASSERT_TRUE(tin->placed);
  EXPECT_GE(tin->promisedError, tolerance);
  EXPECT_LE(tin->promisedError, 1.1 * tolerance + tin->format.heightRounding);

  const auto file = readMesh(request.output);
  ASSERT_TRUE(file) << file.error().describe();
  EXPECT_EQ(file->metresAbout.has_value(), crs.empty());
  const auto report =
      measureElsewhere(file->mesh, {.crsWkt = file->crsWkt, .metresAbout = file->metresAbout}, field);
  ASSERT_TRUE(report) << report.error().describe();
  const Status promise = checkPromise(*report, tin->promisedError);
  EXPECT_TRUE(promise) << promise.error().describe();
  EXPECT_EQ(report->maxAbsError, tin->measured->maxAbsError);

  // A tenth of the mean spacing: of the area in the plan, by sample.
  const double middle = std::abs(dem.north - dem.rows * dem.stepY / 2) * std::numbers::pi / 180;
  const double pixel = 111'000 * std::sqrt(dem.stepX * dem.stepY * std::cos(middle));
  const Checked checked = crs.empty() ? checkInMetres(file->mesh, field, *file->metresAbout, 0.1 * pixel)
                                      : checkOnMap(file->mesh, field, file->crsWkt, 0.1 * pixel);
  EXPECT_EQ(checked.missed, 0U);
  EXPECT_LE(checked.largest, tin->promisedError + 1e-6);
  EXPECT_NEAR(checked.largest, report->maxAbsError, 1e-5 + 1e-3 * tolerance);
}

class DegreesDems : public testing::TestWithParam<DegreesDem> {};
constexpr double kTolerances[] = {40, 100, 250};

TEST_P(DegreesDems, ThePromiseIsKeptInMetres) {
  for (const double tolerance : kTolerances) expectPromise(GetParam(), "", tolerance, ".ply");
}

TEST_P(DegreesDems, ThePromiseIsKeptInAnotherCrs) {
  for (const double tolerance : kTolerances) expectPromise(GetParam(), GetParam().crs, tolerance, ".ply");
}

INSTANTIATE_TEST_SUITE_P(MeasurePlaced, DegreesDems, testing::ValuesIn(kDems), [](const auto& info) {
  std::string name = info.param.name;
  std::erase(name, ' ');
  return name;
});

TEST(MeasurePlaced, FindsThePromiseKeptInEveryFormat) {
  for (const char* extension : {".obj", ".off", ".stl"}) expectPromise(kDems[0], "", 100, extension);
  for (const char* extension : {".obj", ".off", ".gpkg", ".2dm"})
    expectPromise(kDems[0], "utm", 100, extension);
}

TEST(MeasurePlaced, FindsAPlantedError) {
  const RasterHeightfield field = fieldOf(kDems[0]);
  const auto model = build(field);
  ASSERT_TRUE(model);
  const TemporaryFolder folder;
  for (const char* crs : {"", "utm"}) {
    ExtractRequest request;
    request.criterion.maxError = 30;
    request.output = folder.file("tin.ply");
    request.place = {.crs = crs, .isMetric = *crs == '\0'};
    TinExtractor extractor(*model, "m.amt");
    ASSERT_TRUE(extractor.extract(request));
    auto file = readMesh(request.output).value();
    const TinPlace place{.crsWkt = file.crsWkt, .metresAbout = file.metresAbout};
    const auto before = measureElsewhere(file.mesh, place, field).value();
    file.mesh.positions[file.mesh.triangles[40][0]].z += 500;
    const auto after = measureElsewhere(file.mesh, place, field).value();
    EXPECT_GT(after.maxAbsError, before.maxAbsError + 100);
    file.mesh.triangles.erase(file.mesh.triangles.begin() + 40, file.mesh.triangles.begin() + 70);
    EXPECT_GT(measureElsewhere(file.mesh, place, field).value().uncovered, 0U);
  }
}

TEST(MeasurePlaced, CountsHolesOfTheDemThatAreCovered) {
  RasterHeightfield field = fieldOf(kDems[0]);
  const auto model = build(field);
  ASSERT_TRUE(model);
  const TemporaryFolder folder;
  for (const char* crs : {"", "utm"}) {
    ExtractRequest request;
    request.criterion.maxError = 30;
    request.output = folder.file("tin.ply");
    request.place = {.crs = crs, .isMetric = *crs == '\0'};
    TinExtractor extractor(*model, "m.amt");
    ASSERT_TRUE(extractor.extract(request));
    const auto file = readMesh(request.output).value();
    RasterHeightfield holes = field;
    for (std::uint32_t r = 6; r < 11; ++r)
      for (std::uint32_t c = 6; c < 11; ++c) holes.heights[holes.index(c, r)] = std::nan("");
    const auto report =
        measureElsewhere(file.mesh, {.crsWkt = file.crsWkt, .metresAbout = file.metresAbout}, holes).value();
    EXPECT_GE(report.nodataCovered, 15U);
    EXPECT_LE(report.nodataCovered, 25U);
  }
}

TEST(MeasurePlaced, CountsHeightsInFeetAsMetresInAFrameOfMetresAlone) {
  RasterHeightfield field = fieldOf(kDems[0]);
  field.georeference.verticalUnit = "ft";
  field.georeference.verticalUnitMetres = 0.3048;
  const auto model = build(field);
  ASSERT_TRUE(model);
  const TemporaryFolder folder;
  for (const char* crs : {"", "utm"}) {
    ExtractRequest request;
    request.criterion.maxError = 100;
    request.output = folder.file("tin.ply");
    request.certificate = folder.file("c.json");
    request.place = {.crs = crs, .isMetric = *crs == '\0'};
    TinExtractor extractor(*model, "m.amt");
    const auto tin = extractor.extract(request);
    ASSERT_TRUE(tin);
    EXPECT_TRUE(tin->isKept);
    EXPECT_LE(tin->promisedError, 110);
    const auto file = readMesh(request.output).value();
    EXPECT_EQ(file.verticalUnit, *crs == '\0' ? "metre" : "ft");
    EXPECT_EQ(tin->warnings.size(), *crs == '\0' ? 0U : 1U);
  }
}

}  // namespace
}  // namespace arete
