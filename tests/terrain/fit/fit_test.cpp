// SPDX-License-Identifier: GPL-3.0-or-later
//
// Fitted cuts on every generated family: the promise by measure(), which shares no code with the fit; the
// errors by a scan of all samples for every triangle; the least error against an exact linear program.
#include "terrain/fit/fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <string>

#include "datasets/families.h"
#include "terrain/builder/build.h"
#include "terrain/chebyshev_oracle.h"
#include "terrain/features/fixed_vertices.h"
#include "terrain/measure/measure.h"

namespace arete {
namespace {

const RasterFamily& fractal() {
  return *std::ranges::find(rasterFamilies(), "fractal", &RasterFamily::name);
}

TerrainModel modelOf(const RasterHeightfield& field, HoleShape shape, BuildOptions options = {}) {
  options.shape = shape;
  auto model = build(field, options);
  EXPECT_TRUE(model) << model.error().describe();
  return std::move(*model);
}

TriangleMesh meshOf(const TerrainModel& model, const FittedCut& fitted) {
  TriangleMesh mesh;
  for (std::size_t i = 0; i < fitted.cut.vertices.size(); ++i) {
    const Vec2 xy = model.toSource(model.mt.vertices().planPosition(VertexId(fitted.cut.vertices[i])));
    mesh.positions.push_back({xy.x, xy.y, fitted.heights[i]});
  }
  mesh.triangles = fitted.cut.triangles;
  return mesh;
}

MeasureReport measured(const TerrainModel& model, const FittedCut& fitted,
                       const MeasureOptions& options = {}) {
  const TriangleMesh mesh = meshOf(model, fitted);
  const auto report = model.isRaster ? measure(mesh, model.rasterSamples(), options)
                                     : measure(mesh, model.pointSamples(), options);
  EXPECT_TRUE(report) << report.error().describe();
  return report.value_or(MeasureReport{});
}

/// Every sample in every triangle, edges included, and how it depends on the heights of the cut's vertices.
void forSamplesOf(
    const TerrainModel& model, const Cut& cut,
    const std::function<void(std::size_t triangle, std::array<double, 3> weights, double z)>& visit) {
  const MultiTriangulation& mt = model.mt;
  for (std::size_t t = 0; t < cut.triangles.size(); ++t) {
    std::array<Vec2, 3> p;
    for (int i = 0; i < 3; ++i)
      p[i] = mt.vertices().planPosition(VertexId(cut.vertices[cut.triangles[t][i]]));
    const auto turn = [](Vec2 a, Vec2 b, Vec2 c) {
      return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    };
    const double area = turn(p[0], p[1], p[2]);
    for (std::uint32_t v = 0; v < mt.vertexCount(); ++v) {
      const Vec2 q = mt.vertices().planPosition(VertexId(v));
      const std::array<double, 3> w = {turn(q, p[1], p[2]) / area, turn(q, p[2], p[0]) / area,
                                       turn(q, p[0], p[1]) / area};
      if (w[0] >= 0 && w[1] >= 0 && w[2] >= 0) visit(t, w, mt.vertices().height(VertexId(v)));
    }
  }
}

std::vector<double> errorsOf(const TerrainModel& model, const FittedCut& fitted) {
  std::vector<double> errors(fitted.cut.triangles.size(), 0);
  forSamplesOf(model, fitted.cut, [&](std::size_t t, const std::array<double, 3>& w, double z) {
    double height = 0;
    for (int i = 0; i < 3; ++i) height += w[i] * fitted.heights[fitted.cut.triangles[t][i]];
    errors[t] = std::max(errors[t], std::abs(height - z));
  });
  return errors;
}

double leastPossible(const TerrainModel& model, const Cut& cut) {
  std::vector<testing::LinearResidual> residuals;
  forSamplesOf(model, cut, [&](std::size_t t, const std::array<double, 3>& w, double z) {
    testing::LinearResidual r{{}, -z};
    for (int i = 0; i < 3; ++i)
      if (w[i] > 0) r.terms.emplace_back(cut.triangles[t][i], w[i]);
    residuals.push_back(std::move(r));
  });
  return testing::leastMaximum(static_cast<std::uint32_t>(cut.vertices.size()), residuals);
}

void expectFitted(const TerrainModel& model, const FittedCut& fitted, double maxError, bool hasOracle) {
  const MeasureReport report = measured(model, fitted);
  const Status kept = checkPromise(report, maxError, {.allowCoveredNodata = model.options.rimTolerance > 0});
  EXPECT_TRUE(kept) << kept.error().describe();
  EXPECT_LE(report.errorBeyondRounding, fitted.cut.achievedError);
  EXPECT_LE(fitted.cut.achievedError, maxError);
  EXPECT_LE(fitted.cut.triangles.size(), fitted.trianglesBefore);
  ASSERT_EQ(fitted.heights.size(), fitted.cut.vertices.size());
  ASSERT_EQ(fitted.errors.size(), fitted.cut.triangles.size());
  if (!hasOracle) return;
  const std::vector<double> errors = errorsOf(model, fitted);
  for (std::size_t t = 0; t < errors.size(); ++t) ASSERT_NEAR(fitted.errors[t], errors[t], 1e-6) << t;
}

TEST(FitFewestTriangles, KeepsTheToleranceOnEveryFamily) {
  std::size_t before = 0, after = 0;
  for (const RasterFamily& family : rasterFamilies())
    for (const HoleShape shape : {HoleShape::delaunay, HoleShape::dataDependent})
      for (const std::uint64_t seed : {1, 2}) {
        const TerrainModel model = modelOf(family.make(41, 33, seed), shape);
        for (const double maxError : {0.0, 0.5, 3.0, 20.0, 1e9}) {
          SCOPED_TRACE(std::string(family.name) + " " + std::string(toString(shape)) + " seed " +
                       std::to_string(seed) + " within " + std::to_string(maxError));
          const auto fitted = fitFewestTriangles(model, {.maxError = maxError});
          ASSERT_TRUE(fitted) << fitted.error().describe();
          expectFitted(model, *fitted, maxError, seed == 1);
          before += fitted->trianglesBefore;
          after += fitted->cut.triangles.size();
        }
      }
  EXPECT_LT(double(after), 0.95 * double(before)) << after << " of " << before;
}

TEST(FitFewestTriangles, KeepsTheToleranceOverScatteredPoints) {
  for (const PointFamily& family : pointFamilies())
    for (const HoleShape shape : {HoleShape::delaunay, HoleShape::dataDependent}) {
      const auto model = build(family.make(700, 3), {.shape = shape});
      ASSERT_TRUE(model) << family.name;
      for (const double maxError : {0.0, 0.5, 3.0, 20.0}) {
        SCOPED_TRACE(std::string(family.name) + " within " + std::to_string(maxError));
        const auto fitted = fitFewestTriangles(*model, {.maxError = maxError});
        ASSERT_TRUE(fitted) << fitted.error().describe();
        expectFitted(*model, *fitted, maxError, false);
      }
    }
}

TEST(FitFewestTriangles, KeepsTheToleranceWhereRimsWereStraightened) {
  for (const RasterFamily& family : rasterFamilies()) {
    SCOPED_TRACE(family.name);
    const TerrainModel model = modelOf(family.make(60, 50, 5), HoleShape::delaunay, {.rimTolerance = 2});
    const auto fitted = fitFewestTriangles(model, {.maxError = 4});
    ASSERT_TRUE(fitted) << fitted.error().describe();
    expectFitted(model, *fitted, 4, true);
  }
}

TEST(FitFewestTriangles, IsTheSameForAnyNumberOfThreads) {
  for (const RasterFamily& family : rasterFamilies()) {
    const TerrainModel model = modelOf(family.make(90, 70, 4), HoleShape::delaunay);
    RunContext context;
    context.threads = 1;
    const auto one = fitFewestTriangles(model, {.maxError = 2}, {}, context);
    ASSERT_TRUE(one) << family.name;
    for (const int threads : {2, 4}) {
      context.threads = threads;
      const auto other = fitFewestTriangles(model, {.maxError = 2}, {}, context);
      ASSERT_TRUE(other) << family.name;
      EXPECT_EQ(other->cut.ids, one->cut.ids) << family.name;
      EXPECT_EQ(other->heights, one->heights) << family.name;
      EXPECT_EQ(other->errors, one->errors) << family.name;
    }
  }
}

TEST(FitFewestTriangles, KeepsTheHeightsOfFixedVerticesUnlessTold) {
  const RasterHeightfield field = fractal().make(64, 64, 9);
  const auto fixed = chooseFixedVertices(field, {});
  ASSERT_TRUE(fixed);
  ASSERT_FALSE(fixed->vertices.empty());
  const TerrainModel model = modelOf(field, HoleShape::delaunay, {.fixedVertices = fixed->vertices});
  const auto count = [&](const FitOptions& options) {
    const auto fitted = fitFewestTriangles(model, {.maxError = 5}, options);
    EXPECT_TRUE(fitted);
    std::size_t moved = 0;
    for (std::size_t i = 0; i < fitted->heights.size(); ++i) {
      const std::uint32_t sample = model.mt.vertices().samples[fitted->cut.vertices[i]];
      if (std::ranges::binary_search(fixed->vertices, sample) && fitted->heights[i] != field.heights[sample])
        ++moved;
    }
    return moved;
  };
  EXPECT_EQ(count({}), 0u);
  EXPECT_GT(count({.keepsFixedHeights = false}), 0u);
}

TEST(FitFewestTriangles, HoldsTwoTolerancesInsideAndOutsideARegion) {
  for (const RasterFamily& family : rasterFamilies()) {
    SCOPED_TRACE(family.name);
    const RasterHeightfield field = family.make(60, 50, 6);
    const TerrainModel model = modelOf(field, HoleShape::delaunay);
    const Region region({{{10, 12}, {40, 9}, {33, 41}, {12, 37}}});
    for (const double outside : {10.0, std::numeric_limits<double>::infinity()}) {
      const auto fitted =
          fitFewestTriangles(model, {.maxError = 1, .region = &region, .outsideError = outside});
      ASSERT_TRUE(fitted) << fitted.error().describe();
      std::vector<std::uint8_t> inside(field.size());
      for (std::uint32_t s = 0; s < inside.size(); ++s)
        inside[s] = region.contains({double(s % field.columns), double(s / field.columns)});
      const Status kept = checkPromise(measured(model, *fitted, {.mask = inside}), 1);
      EXPECT_TRUE(kept) << kept.error().describe();
      EXPECT_TRUE(keepsPromise(measured(model, *fitted), outside));
    }
  }
}

TEST(FitFewestTriangles, SavesMoreWithMoreRings) {
  const TerrainModel model = modelOf(fractal().make(200, 200, 1), HoleShape::delaunay);
  std::size_t last = std::numeric_limits<std::size_t>::max();
  for (const std::uint32_t rings : {1u, 2u, 3u}) {
    const auto fitted = fitFewestTriangles(model, {.maxError = 3}, {.rings = rings});
    ASSERT_TRUE(fitted);
    EXPECT_LT(fitted->cut.triangles.size(), last) << rings;
    last = fitted->cut.triangles.size();
  }
}

TEST(FitFewestTriangles, RefusesToleranceThatMakeNoSense) {
  const TerrainModel model = modelOf(fractal().make(9, 9, 1), HoleShape::delaunay);
  for (const FitTolerance& tolerance :
       {FitTolerance{.maxError = -1}, FitTolerance{.maxError = std::numeric_limits<double>::quiet_NaN()},
        FitTolerance{.maxError = 3, .outsideError = 2}}) {
    const auto fitted = fitFewestTriangles(model, tolerance);
    ASSERT_FALSE(fitted);
    EXPECT_EQ(fitted.error().code, ErrorCode::usage);
  }
}

TEST(FitFewestTriangles, CanBeInterruptedAndTellsHowFarItIs) {
  const TerrainModel model = modelOf(fractal().make(80, 80, 1), HoleShape::delaunay);
  std::atomic<bool> cancel = false;
  RunContext context;
  context.cancel = &cancel;
  double last = 0;
  std::size_t told = 0;
  context.progress = [&](std::string_view stage, double fraction) {
    if (stage != "fitting") return;
    EXPECT_GE(fraction, last);
    EXPECT_LE(fraction, 1);
    last = fraction;
    if (++told == 5) cancel = true;
  };
  const auto fitted = fitFewestTriangles(model, {.maxError = 2}, {}, context);
  ASSERT_FALSE(fitted);
  EXPECT_EQ(fitted.error().code, ErrorCode::interrupted);
  EXPECT_EQ(told, 5u);
}

TEST(FitLeastError, HalvesTheErrorOfARidge) {
  // A fold between two columns of samples that the corners cannot see: 0 at both ends, 8 in the middle.
  RasterHeightfield field;
  field.columns = 9;
  field.rows = 2;
  field.georeference.hasGeoTransform = true;
  field.georeference.geoTransform = {0, 1, 0, 0, 0, -1};
  for (int r = 0; r < 2; ++r)
    for (int c = 0; c < 9; ++c) field.heights.push_back(8 - 2 * std::abs(c - 4));
  const TerrainModel model = modelOf(field, HoleShape::delaunay);
  const auto cut = takeCut(model.mt, UniformError(8));
  ASSERT_TRUE(cut);
  ASSERT_EQ(cut->triangles.size(), 2u);
  const auto fitted = fitLeastError(model, *cut);
  ASSERT_TRUE(fitted);
  EXPECT_EQ(fitted->errorBefore, 8);
  EXPECT_NEAR(fitted->cut.achievedError, 4, 0.04);
  expectFitted(model, *fitted, fitted->cut.achievedError, true);
}

TEST(Fit, KeepsItsErrorsOverPointsInRowsThatAreNearlyStraight) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const double waver : {1e-13, 1e-12, 1e-11, 1e-10, 1e-9, 1e-7})
    for (const HoleShape shape : {HoleShape::delaunay, HoleShape::dataDependent}) {
      SCOPED_TRACE(waver);
      PointHeightfield points;
      for (int row = 0; row < 3; ++row)
        for (int i = 0; i < 50; ++i) {
          const double x = i, y = 20 * row + waver * unit(random);
          points.positions.push_back({0.8 * x - 0.6 * y, 0.6 * x + 0.8 * y});
          points.heights.push_back(i < 20 + 3 * row ? 100 : 10 * unit(random));
        }
      const auto model = build(points, {.shape = shape});
      ASSERT_TRUE(model) << model.error().describe();
      for (const double tolerance : {0.0, 1.0, 8.0}) {
        const auto cut = takeCut(model->mt, UniformError(tolerance));
        ASSERT_TRUE(cut);
        const auto least = fitLeastError(*model, *cut);
        ASSERT_TRUE(least) << least.error().describe();
        EXPECT_LE(least->cut.achievedError, cut->achievedError + 1e-9);
        EXPECT_TRUE(keepsPromise(measured(*model, *least), least->cut.achievedError));
        const auto fewest = fitFewestTriangles(*model, {.maxError = tolerance});
        ASSERT_TRUE(fewest) << fewest.error().describe();
        EXPECT_LE(fewest->cut.achievedError, tolerance + 1e-9);
        EXPECT_TRUE(keepsPromise(measured(*model, *fewest), tolerance));
      }
    }
}

TEST(FitLeastError, LeavesWhatIsRoundingAlone) {
  // Far from zero a plane through three points is some billionths off their heights.
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  PointHeightfield points;
  for (int i = 0; i < 60; ++i) {
    points.positions.push_back({1e9 + 100 * unit(random), -1e9 + 100 * unit(random)});
    points.heights.push_back(1e5 + 100 * unit(random));
  }
  const auto model = build(points);
  ASSERT_TRUE(model) << model.error().describe();
  for (const double tolerance : {0.0, 1e-6, 1.0}) {
    const auto cut = takeCut(model->mt, UniformError(tolerance));
    ASSERT_TRUE(cut);
    const auto least = fitLeastError(*model, *cut);
    ASSERT_TRUE(least) << least.error().describe();
    EXPECT_LE(least->cut.achievedError, cut->achievedError);
  }
}

TEST(FitLeastError, ComesNearTheLeastThatALinearProgramFinds) {
  double sum = 0;
  std::size_t cases = 0;
  for (const RasterFamily& family : rasterFamilies())
    for (const std::uint64_t seed : {1, 2}) {
      const TerrainModel model = modelOf(family.make(15, 13, seed), HoleShape::delaunay);
      const auto cut =
          takeCut(model.mt, UniformError(0), {.maxTriangles = model.mt.rootTriangleCount() + 24});
      ASSERT_TRUE(cut);
      SCOPED_TRACE(std::string(family.name) + " seed " + std::to_string(seed));
      const auto fitted = fitLeastError(model, *cut, {.keepsFixedHeights = false});
      ASSERT_TRUE(fitted) << fitted.error().describe();
      EXPECT_EQ(fitted->cut.ids, cut->ids);
      expectFitted(model, *fitted, std::max(cut->achievedError, fitted->cut.achievedError), true);
      EXPECT_LE(fitted->cut.achievedError, cut->achievedError + 1e-9);
      const double least = leastPossible(model, *cut);
      EXPECT_GE(fitted->cut.achievedError, least - 1e-6);
      if (least < 1e-6) continue;
      sum += std::log(fitted->cut.achievedError / least);
      ++cases;
    }
  ASSERT_GT(cases, 10u);
  EXPECT_LT(std::exp(sum / double(cases)), 1.02);
}

}  // namespace
}  // namespace arete
