// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cuts without a mean error on every generated family: the mean and the promise by measure(), which shares no
// code with the fit; a fit whose heights are known; what bounds, fixed heights and regions leave.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "datasets/families.h"
#include "full_run.h"
#include "terrain/builder/build.h"
#include "terrain/features/fixed_vertices.h"
#include "terrain/fit/fit.h"
#include "terrain/measure/measure.h"

namespace arete {
namespace {

RasterHeightfield rasterOf(std::uint32_t columns, std::uint32_t rows, double (*height)(double x, double y)) {
  RasterHeightfield field;
  field.columns = columns;
  field.rows = rows;
  field.georeference.hasGeoTransform = true;
  field.georeference.geoTransform = {0, 1, 0, 0, 0, -1};
  for (std::uint32_t r = 0; r < rows; ++r)
    for (std::uint32_t c = 0; c < columns; ++c) field.heights.push_back(height(c, r));
  return field;
}

MeasureReport measuredOf(const TerrainModel& model, const Cut& cut, const std::vector<double>* heights,
                         const MeasureOptions& options = {}) {
  TriangleMesh mesh;
  for (std::size_t i = 0; i < cut.vertices.size(); ++i) {
    const VertexId v(cut.vertices[i]);
    const Vec2 xy = model.toSource(model.mt.vertices().planPosition(v));
    mesh.positions.push_back({xy.x, xy.y, heights ? (*heights)[i] : model.mt.vertices().height(v)});
  }
  mesh.triangles = cut.triangles;
  const auto report = model.isRaster ? measure(mesh, model.rasterSamples(), options)
                                     : measure(mesh, model.pointSamples(), options);
  EXPECT_TRUE(report) << report.error().describe();
  return report.value_or(MeasureReport{});
}

/// Fits a cut and checks what must hold of every fit; the mean errors before and after, in tolerances.
std::pair<double, double> expectUnbiased(const TerrainModel& model, double maxError,
                                         double largestMean = 0.02) {
  const auto cut = takeCut(model.mt, UniformError(maxError));
  EXPECT_TRUE(cut);
  const auto fitted = fitUnbiased(model, *cut, {.maxError = maxError});
  EXPECT_TRUE(fitted) << fitted.error().describe();
  if (!fitted) return {};
  EXPECT_EQ(fitted->cut.ids, cut->ids);
  EXPECT_EQ(fitted->cut.vertices, cut->vertices);
  EXPECT_EQ(fitted->trianglesBefore, cut->triangles.size());
  EXPECT_EQ(fitted->errorBefore, cut->achievedError);
  const MeasureReport before = measuredOf(model, *cut, nullptr),
                      after = measuredOf(model, fitted->cut, &fitted->heights);
  const Status kept = checkPromise(after, maxError, {.allowCoveredNodata = model.options.rimTolerance > 0});
  EXPECT_TRUE(kept) << kept.error().describe();
  EXPECT_LE(after.errorBeyondRounding, fitted->cut.achievedError);
  EXPECT_LE(fitted->cut.achievedError, maxError);
  EXPECT_LE(std::abs(after.meanError), largestMean * maxError)
      << cut->triangles.size() << " triangles, mean error " << before.meanError << " before";
  if (!model.georeference.repeatsFirstColumn) {
    const double height = std::abs(model.mt.vertices().height(VertexId(0)));
    EXPECT_NEAR(fitted->meanBefore, before.meanError,
                1e-9 * std::max(1.0, std::abs(before.meanError)) + 0x1p-50 * height);
  }
  if (!(maxError > 0)) return {};
  return {before.meanError / maxError, after.meanError / maxError};
}

TEST(FitUnbiased, RemovesTheMeanErrorAndKeepsTrianglesAndToleranceOnEveryFamily) {
  for (const RasterFamily& family : rasterFamilies())
    for (const HoleShape shape : {HoleShape::delaunay, HoleShape::dataDependent})
      for (std::uint64_t seed = 1; seed <= (test::isFull() ? 4u : 1u); ++seed) {
        const auto model = build(family.make(61, 47, seed), {.shape = shape});
        ASSERT_TRUE(model) << model.error().describe();
        for (const double part : {0.0, 0.02, 0.1, 0.4, 1.0}) {
          const double maxError = part * model->mt.largestError();
          SCOPED_TRACE(std::string(family.name) + " " + std::string(toString(shape)) + " seed " +
                       std::to_string(seed) + " within " + std::to_string(maxError));
          expectUnbiased(*model, maxError);
        }
      }
}

TEST(FitUnbiased, RemovesTheMeanErrorOverScatteredPoints) {
  for (const PointFamily& family : pointFamilies())
    for (const HoleShape shape : {HoleShape::delaunay, HoleShape::dataDependent}) {
      const auto model = build(family.make(900, 3), {.shape = shape});
      ASSERT_TRUE(model) << family.name;
      for (const double part : {0.0, 0.02, 0.1, 0.4}) {
        const double maxError = part * model->mt.largestError();
        SCOPED_TRACE(std::string(family.name) + " within " + std::to_string(maxError));
        expectUnbiased(*model, maxError);
      }
    }
}

TEST(FitUnbiased, LiftsATinThatLiesUnderADomeByItsMeanErrorInEveryQuarter) {
  const auto model = build(rasterOf(
      97, 97, [](double x, double y) { return 500 - (x - 48) * (x - 48) / 8 - (y - 40) * (y - 40) / 8; }));
  ASSERT_TRUE(model);
  for (const double maxError : {1.0, 4.0, 20.0}) {
    const auto [before, after] = expectUnbiased(*model, maxError, 1e-3);
    EXPECT_LT(before, -0.2) << maxError;
    const auto cut = takeCut(model->mt, UniformError(maxError));
    const auto fitted = fitUnbiased(*model, *cut, {.maxError = maxError});
    ASSERT_TRUE(fitted);
    for (const int quarter : {0, 1, 2, 3}) {
      std::vector<std::uint8_t> mask(97 * 97);
      for (std::uint32_t s = 0; s < mask.size(); ++s)
        mask[s] = ((s % 97 > 48) + 2 * (s / 97 > 48)) == quarter;
      const MeasureReport report = measuredOf(*model, fitted->cut, &fitted->heights, {.mask = mask});
      EXPECT_LT(std::abs(report.meanError), 0.1 * maxError) << maxError << " in quarter " << quarter;
    }
  }
}

TEST(FitUnbiased, IsTheLeastSquaresFitWhereNoBoundIsNear) {
  // A fold between two columns of samples: on each row, the line with the least squares is the mean.
  const auto model = build(rasterOf(9, 2, [](double x, double) { return 8 - 2 * std::abs(x - 4); }));
  ASSERT_TRUE(model);
  const auto cut = takeCut(model->mt, UniformError(8));
  ASSERT_TRUE(cut);
  ASSERT_EQ(cut->triangles.size(), 2u);
  const auto fitted = fitUnbiased(*model, *cut, {.maxError = 8});
  ASSERT_TRUE(fitted);
  ASSERT_EQ(fitted->heights.size(), 4u);
  for (const double height : fitted->heights) EXPECT_NEAR(height, 32.0 / 9, 0.01);
  EXPECT_NEAR(fitted->meanBefore, -32.0 / 9, 1e-12);
}

TEST(FitUnbiased, IsTheSameForAnyNumberOfThreads) {
  for (const RasterFamily& family : rasterFamilies()) {
    const auto model = build(family.make(90, 70, 4));
    ASSERT_TRUE(model);
    const double maxError = 0.1 * model->mt.largestError();
    const auto cut = takeCut(model->mt, UniformError(maxError));
    ASSERT_TRUE(cut);
    RunContext context;
    context.threads = 1;
    const auto one = fitUnbiased(*model, *cut, {.maxError = maxError}, {}, context);
    ASSERT_TRUE(one) << family.name;
    context.threads = 4;
    const auto other = fitUnbiased(*model, *cut, {.maxError = maxError}, {}, context);
    ASSERT_TRUE(other) << family.name;
    EXPECT_EQ(other->heights, one->heights) << family.name;
    EXPECT_EQ(other->errors, one->errors) << family.name;
  }
}

TEST(FitUnbiased, LeavesFixedVerticesAndLetsTheOthersMakeUpForThem) {
  for (const RasterFamily& family : rasterFamilies()) {
    SCOPED_TRACE(family.name);
    const RasterHeightfield field = family.make(64, 64, 9);
    const auto fixed = chooseFixedVertices(field, {});
    ASSERT_TRUE(fixed);
    const auto model = build(field, {.fixedVertices = fixed->vertices});
    ASSERT_TRUE(model);
    const double maxError = 0.1 * model->mt.largestError();
    const auto cut = takeCut(model->mt, UniformError(maxError));
    ASSERT_TRUE(cut);
    const auto fitted = fitUnbiased(*model, *cut, {.maxError = maxError});
    ASSERT_TRUE(fitted);
    for (std::size_t i = 0; i < fitted->heights.size(); ++i) {
      const std::uint32_t sample = model->mt.vertices().samples[fitted->cut.vertices[i]];
      if (std::ranges::binary_search(fixed->vertices, sample)) {
        EXPECT_EQ(fitted->heights[i], field.heights[sample]);
      }
    }
    const MeasureReport report = measuredOf(*model, fitted->cut, &fitted->heights);
    EXPECT_TRUE(keepsPromise(report, maxError));
    EXPECT_LE(std::abs(report.meanError), 0.02 * maxError) << fixed->vertices.size() << " fixed";
  }
}

TEST(FitUnbiased, RemovesTheMeanErrorInARegionAndOutsideIt) {
  for (const RasterFamily& family : rasterFamilies()) {
    SCOPED_TRACE(family.name);
    const RasterHeightfield field = family.make(80, 70, 6);
    const auto model = build(field);
    ASSERT_TRUE(model);
    const Region region({{{10, 12}, {50, 9}, {43, 51}, {12, 47}}});
    const double inside = 0.03 * model->mt.largestError();
    for (const double outside : {10 * inside, std::numeric_limits<double>::infinity()}) {
      const auto cut = takeCut(model->mt, RegionError(region, model->mt.metric(), inside, outside));
      ASSERT_TRUE(cut);
      const auto fitted =
          fitUnbiased(*model, *cut, {.maxError = inside, .region = &region, .outsideError = outside});
      ASSERT_TRUE(fitted) << fitted.error().describe();
      EXPECT_EQ(fitted->cut.ids, cut->ids);
      std::vector<std::uint8_t> isInside(field.size()), isOutside(field.size());
      for (std::uint32_t s = 0; s < isInside.size(); ++s) {
        isInside[s] = region.contains({double(s % field.columns), double(s / field.columns)});
        isOutside[s] = !isInside[s];
      }
      const MeasureReport in = measuredOf(*model, fitted->cut, &fitted->heights, {.mask = isInside}),
                          out = measuredOf(*model, fitted->cut, &fitted->heights, {.mask = isOutside});
      const Status kept = checkPromise(in, inside);
      EXPECT_TRUE(kept) << kept.error().describe();
      EXPECT_TRUE(keepsPromise(out, std::min(outside, std::max(inside, cut->achievedError))));
      EXPECT_LE(std::abs(in.meanError), 0.02 * inside);
      EXPECT_LE(std::abs(out.meanError), 0.02 * std::min(outside, std::max(inside, cut->achievedError)));
    }
  }
}

TEST(FitUnbiased, KeepsToleranceThatIsNearTheRoundingOfHeights) {
  for (const double base : {1e6, -1e9, 1e12}) {
    RasterHeightfield field = rasterFamilies()[2].make(40, 40, 3);
    for (double& z : field.heights) z = base * (1 + 0x1p-44 * std::round(z));
    const auto model = build(field);
    ASSERT_TRUE(model) << model.error().describe();
    for (const double part : {1e-3, 0.1, 0.5}) {
      SCOPED_TRACE(testing::Message() << base << " " << part);
      expectUnbiased(*model, part * model->mt.largestError(), 1);
    }
  }
}

TEST(FitUnbiased, IsBoundedByTheErrorOfTheCutWhereNoToleranceIsStated) {
  const auto model = build(rasterFamilies()[2].make(60, 60, 2));
  ASSERT_TRUE(model);
  const auto cut = takeCut(model->mt, UniformError(std::numeric_limits<double>::infinity()));
  ASSERT_TRUE(cut);
  const auto fitted = fitUnbiased(*model, *cut, {.maxError = std::numeric_limits<double>::infinity()});
  ASSERT_TRUE(fitted);
  EXPECT_LE(fitted->cut.achievedError, cut->achievedError);
  EXPECT_TRUE(keepsPromise(measuredOf(*model, fitted->cut, &fitted->heights), cut->achievedError));
}

TEST(FitUnbiased, RefusesToleranceThatMakeNoSenseAndCanBeInterrupted) {
  const auto model = build(rasterFamilies()[2].make(80, 80, 1));
  ASSERT_TRUE(model);
  const auto cut = takeCut(model->mt, UniformError(3));
  ASSERT_TRUE(cut);
  for (const FitTolerance& tolerance :
       {FitTolerance{.maxError = -1}, FitTolerance{.maxError = std::numeric_limits<double>::quiet_NaN()},
        FitTolerance{.maxError = 3, .outsideError = 2}}) {
    const auto fitted = fitUnbiased(*model, *cut, tolerance);
    ASSERT_FALSE(fitted);
    EXPECT_EQ(fitted.error().code, ErrorCode::usage);
  }
  std::atomic<bool> cancel = false;
  RunContext context;
  context.cancel = &cancel;
  context.progress = [&](std::string_view stage, double) { cancel = cancel || stage == "fitting"; };
  const auto fitted = fitUnbiased(*model, *cut, {.maxError = 3}, {}, context);
  ASSERT_FALSE(fitted);
  EXPECT_EQ(fitted.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace arete
