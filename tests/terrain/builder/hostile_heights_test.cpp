// SPDX-License-Identifier: GPL-3.0-or-later
//
// The promise over heights of every magnitude, offset, digits and outliers. Stored errors are held against
// whole numbers (exact_plane.h); bounds against law 10; cuts against measure().
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "datasets/hostile_heights.h"
#include "engine/cut/cut.h"
#include "full_run.h"
#include "terrain/builder/build.h"
#include "terrain/exact_plane.h"
#include "terrain/laws/validate_model.h"
#include "terrain/measure/measure.h"
#include "terrain/model/lone_heights.h"

namespace arete {
namespace {

std::uint64_t seedCount() {
  return test::isFull() ? 2000 : 60;
}

/// The corners of a triangle, and every vertex of the model that it covers, against the stored error.
void expectErrorsHold(const TerrainModel& model, const std::string& what) {
  const MultiTriangulation& mt = model.mt;
  std::vector<Vec3> vertices;
  for (std::uint32_t v = 0; v < mt.vertexCount(); ++v) vertices.push_back(mt.position(VertexId(v)));
  for (std::uint32_t t = 0; t < mt.triangleIdCount(); ++t) {
    const NodeId creator = mt.creator(TriangleId(t));
    if (creator.isValid() && mt.remover(TriangleId(t)) == creator) continue;
    const auto c = mt.corners(TriangleId(t), creator);
    const std::array<Vec3, 3> corner = {vertices[c[0]], vertices[c[1]], vertices[c[2]]};
    const test::ExactPlane plane(corner);
    const auto [xLow, xHigh] = std::minmax({corner[0].x, corner[1].x, corner[2].x});
    const auto [yLow, yHigh] = std::minmax({corner[0].y, corner[1].y, corner[2].y});
    for (const Vec3& v : vertices)
      if (v.x >= xLow && v.x <= xHigh && v.y >= yLow && v.y <= yHigh && plane.covers(v)) {
        ASSERT_TRUE(plane.isWithin(v, mt.error(TriangleId(t)))) << what << ", triangle " << t;
      }
  }
}

TriangleMesh meshOf(const TerrainModel& model, const Cut& cut) {
  TriangleMesh mesh;
  for (const std::uint32_t v : cut.vertices) {
    const Vec3 p = model.mt.position(VertexId(v));
    const Vec2 at = model.toSource({p.x, p.y});
    mesh.positions.push_back({at.x, at.y, p.z});
  }
  mesh.triangles.assign(cut.triangles.begin(), cut.triangles.end());
  return mesh;
}

template <class Heightfield>
void expectCutsMeasured(const TerrainModel& model, const Heightfield& field, const std::string& what) {
  const double largest = model.mt.largestError();
  for (const double part : {0.0, 1e-6, 0.01, 0.3, 1.0}) {
    const double tolerance = part * largest;
    const auto cut = takeCut(model.mt, UniformError(tolerance));
    ASSERT_TRUE(cut) << what;
    const auto report = measure(meshOf(model, *cut), field);
    ASSERT_TRUE(report) << what << ": " << report.error().describe();
    const Status kept = checkPromise(*report, tolerance);
    EXPECT_TRUE(kept) << what << ", tolerance " << tolerance << ": " << kept.error().describe();
    EXPECT_LE(report->errorBeyondRounding, cut->achievedError) << what;
  }
}

template <class Heightfield>
void expectPromise(const Heightfield& field, HoleShape shape, bool isOrdinary, const std::string& what) {
  BuildOptions options;
  options.shape = shape;
  const auto model = build(field, options);
  if (!model) {
    EXPECT_FALSE(isOrdinary) << what << ": " << model.error().describe();
    EXPECT_EQ(model.error().code, ErrorCode::invalidData) << what;
    EXPECT_EQ(model.error().culprit, field.source) << what;
    return;
  }
  expectErrorsHold(*model, what);
  const Status laws = validateModel(*model, {.everyTriangle = true});
  EXPECT_TRUE(laws) << what << ": " << laws.error().describe();
  expectCutsMeasured(*model, field, what);
}

TEST(HostileHeights, KeepThePromiseOrAreRefusedByName) {
  for (std::uint64_t seed = 1; seed <= seedCount(); ++seed) {
    const HostileHeights made = hostileHeights(seed, 13, 11);
    expectPromise(made.field, seed % 3 == 0 ? HoleShape::dataDependent : HoleShape::delaunay, made.isOrdinary,
                  made.what);
  }
}

TEST(HostileHeights, KeepThePromiseAsScatteredPoints) {
  for (std::uint64_t seed = 1; seed <= seedCount(); ++seed) {
    const HostileHeights made = hostileHeights(seed, 11, 9);
    expectPromise(hostilePoints(seed, 11, 9), seed % 3 == 0 ? HoleShape::dataDependent : HoleShape::delaunay,
                  made.isOrdinary, made.what);
  }
}

TEST(HostileHeights, StandAloneWhereTheyWerePlantedAndNowhereElse) {
  for (std::uint64_t seed = 1; seed <= 20 * seedCount(); ++seed) {
    const HostileHeights made = hostileHeights(seed, 17, 15);
    if (!made.isOrdinary) continue;
    EXPECT_EQ(loneHeights(made.field.heights).count, made.planted) << made.what;
  }
}

/// 41 x 33 hills in whole metres, of at most 600.
RasterHeightfield hills() {
  RasterHeightfield field;
  field.columns = 41;
  field.rows = 33;
  field.source = "hills";
  for (int y = 0; y < 33; ++y)
    for (int x = 0; x < 41; ++x)
      field.heights.push_back(std::nearbyint(300 * std::sin(x / 6.0) * std::cos(y / 5.0)));
  return field;
}

std::size_t trianglesWithin(const RasterHeightfield& field, double tolerance) {
  const auto model = build(field);
  EXPECT_TRUE(model) << model.error().describe();
  const auto cut = takeCut(model->mt, UniformError(tolerance));
  const auto report = measure(meshOf(*model, *cut), field);
  EXPECT_TRUE(checkPromise(*report, tolerance));
  return cut->triangles.size();
}

TEST(HostileHeights, LeaveTrianglesAwayFromASpikeAsIfItWereNotThere) {
  const std::size_t without = trianglesWithin(hills(), 5);
  for (const double spike : {-9999.0, -32768.0, 1e6, 1e9, 1e20, -9.9e29}) {
    SCOPED_TRACE(spike);
    RasterHeightfield field = hills();
    field.heights[16 * 41 + 20] = spike;
    const std::size_t with = trianglesWithin(field, 5);
    EXPECT_GE(with, without);
    EXPECT_LE(with, without + 60) << "the spike's own triangles and those that join them to the others";
  }
}

TEST(HostileHeights, KeepCodesOfExactErrors) {
  // Roofs whose ridge is 1, 5 or 10 above the plane that replaces it, on ground of any height.
  for (const double error : {1.0, 5.0, 10.0, 0.25})
    for (const double ground : {0.0, 3.0, 1e6, 1e9, -4e12}) {
      SCOPED_TRACE(testing::Message() << error << " on " << ground);
      RasterHeightfield field;
      field.columns = field.rows = 9;
      field.heights.assign(81, ground);
      for (int i = 0; i < 9; ++i) field.heights[i * 9 + 4] += error;
      const auto model = build(field);
      ASSERT_TRUE(model);
      EXPECT_EQ(takeCut(model->mt, UniformError(error))->triangles.size(), 2u);
      EXPECT_GT(takeCut(model->mt, UniformError(std::nextafter(error, 0)))->triangles.size(), 2u);
    }
}

TEST(HostileHeights, AreRefusedWithTheirSourceWhereNoFormatHoldsThem) {
  for (const double spike : {1e31, -1e300}) {
    RasterHeightfield field = hills();
    field.heights[500] = spike;
    const auto model = build(field);
    ASSERT_FALSE(model);
    EXPECT_EQ(model.error().code, ErrorCode::invalidData);
    EXPECT_EQ(model.error().culprit, "hills");
  }
}

TEST(HostileHeights, OriginsThatBlurPixelsAreRefused) {
  for (const double origin : {0.0, 5e5, -1e12, 1e17, -1e15, 1e300})
    for (const int axis : {0, 3}) {
      SCOPED_TRACE(origin);
      RasterHeightfield field = hills();
      field.georeference.geoTransform = {0, 1, 0, 0, 0, -1};
      field.georeference.geoTransform[std::size_t(axis)] = origin;
      const auto model = build(field);
      EXPECT_EQ(bool(model), std::abs(origin) < 1e14);
      if (!model) {
        EXPECT_EQ(model.error().culprit, "hills");
      }
    }
}

}  // namespace
}  // namespace arete
