// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/measure/measure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "terrain/measure_fixture.h"

namespace arete {
namespace {

using namespace measuring_test;

TEST(Measure, FindsNoErrorOnAPlane) {
  const RasterHeightfield dem = raster(9, 7, slope);
  const MeasureReport report = measured(twoTriangles(dem), dem);
  EXPECT_EQ(report.triangles, 2u);
  EXPECT_EQ(report.vertices, 4u);
  EXPECT_EQ(report.samples, 63u);
  EXPECT_EQ(report.valid, 63u);
  EXPECT_EQ(report.covered, 63u);
  EXPECT_EQ(report.uncovered, 0u);
  EXPECT_EQ(report.isolated, 0u);
  EXPECT_EQ(report.doublyCovered, 0u);
  EXPECT_EQ(report.overlapped, 0u);
  EXPECT_EQ(report.nodataCovered, 0u);
  EXPECT_LT(report.maxAbsError, 1e-12);
  EXPECT_DOUBLE_EQ(report.tinAreaPixels, 48);
  EXPECT_DOUBLE_EQ(report.domainAreaPixels, 48);
  EXPECT_TRUE(keepsPromise(report, 0));
}

TEST(Measure, FindsAPlantedError) {
  RasterHeightfield dem = raster(9, 7, slope, {1000, 10, 0, 2000, 0, -10});
  const TriangleMesh mesh = twoTriangles(dem);
  dem.heights[dem.index(5, 2)] += 4;
  dem.heights[dem.index(1, 3)] -= 2;
  const MeasureReport report = measured(mesh, dem);
  EXPECT_NEAR(report.maxAbsError, 4, 1e-12);
  EXPECT_NEAR(report.meanError, -2.0 / 63, 1e-12);
  EXPECT_NEAR(report.meanAbsError, 6.0 / 63, 1e-12);
  EXPECT_NEAR(report.rmsError, std::sqrt(20.0 / 63), 1e-12);
  ASSERT_TRUE(report.worst);
  EXPECT_EQ(report.worst->column, 5u);
  EXPECT_EQ(report.worst->row, 2u);
  EXPECT_EQ(report.worst->sample, 23u);
  EXPECT_EQ(report.worst->x, 1055);
  EXPECT_EQ(report.worst->y, 1975);
  EXPECT_EQ(report.worst->triangle, 1u);
  EXPECT_EQ(report.worst->demHeight, 108);
  EXPECT_NEAR(report.worst->tinHeight, 104, 1e-12);
  EXPECT_NEAR(report.worst->error(), -4, 1e-12);
  EXPECT_TRUE(keepsPromise(report, 4));
  EXPECT_FALSE(keepsPromise(report, 3.99));
  EXPECT_EQ(checkPromise(report, 3.99).error().code, ErrorCode::brokenPromise);
}

TEST(Measure, SeesTheDiagonalThatWasTaken) {
  const RasterHeightfield dem = raster(3, 3, [](double c, double r) { return c * r; });
  TriangleMesh mesh = twoTriangles(dem);
  // On the diagonal (0,0)-(2,2) the TIN is 4 * t, so 2 at the middle, where the DEM has 1.
  EXPECT_EQ(measured(mesh, dem).worst->tinHeight, 2);
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}};
  EXPECT_EQ(measured(mesh, dem).worst->error(), -1);
}

TEST(Measure, CountsUncoveredSamples) {
  const RasterHeightfield dem = raster(9, 7, slope);
  TriangleMesh mesh = finest(dem);
  const MeasureReport whole = measured(mesh, dem);
  EXPECT_EQ(whole.covered, 63u);
  EXPECT_EQ(whole.overlapped, 0u);
  EXPECT_EQ(whole.maxAbsError, 0);
  // All triangles at the corner sample of the raster, and all around an inner one.
  std::erase_if(mesh.triangles, [&](const auto& t) {
    return std::ranges::count(t, dem.index(0, 0)) > 0 || std::ranges::count(t, dem.index(4, 4)) > 0;
  });
  const MeasureReport report = measured(mesh, dem);
  EXPECT_EQ(report.uncovered, 2u);
  EXPECT_EQ(report.covered, 61u);
  EXPECT_FALSE(keepsPromise(report, 100));
}

TEST(Measure, CountsOverlaps) {
  const RasterHeightfield dem = raster(9, 7, slope);
  TriangleMesh mesh = twoTriangles(dem);
  for (const auto& [c, r] : {std::array{2.0, 1.0}, {6.0, 1.0}, {2.0, 5.0}})
    mesh.positions.push_back(vertex(dem, c, r, slope(c, r)));
  mesh.triangles.push_back({4, 5, 6});
  const MeasureReport report = measured(mesh, dem);
  // Strictly inside the planted triangle: (3,2), (4,2), (3,3). The big diagonal, from (0,0) to (8,6), passes
  // through (4,3) only.
  EXPECT_EQ(report.doublyCovered, 3u);
  EXPECT_EQ(report.overlapped, 3u + 12u);
  EXPECT_EQ(report.uncovered, 0u);
  EXPECT_FALSE(keepsPromise(report, 100));
}

TEST(Measure, SeesADuplicateTriangleWhereNoSampleIsInside) {
  const RasterHeightfield dem = raster(5, 5, slope);
  TriangleMesh mesh = finest(dem);
  mesh.triangles.push_back(mesh.triangles[10]);
  const MeasureReport report = measured(mesh, dem);
  EXPECT_EQ(report.doublyCovered, 0u);
  EXPECT_GT(report.overlapped, 0u);
  EXPECT_GT(report.tinAreaPixels, report.domainAreaPixels);
  EXPECT_FALSE(keepsPromise(report, 100));
}

TEST(Measure, TakesTheLargestErrorOfSeveralTriangles) {
  const RasterHeightfield dem = raster(3, 3, [](double, double) { return 0.0; });
  TriangleMesh mesh = twoTriangles(dem);
  for (const double z : {1.0, -5.0, 2.0}) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const auto& [c, r] : {std::array{-1.0, -1.0}, {5.0, -1.0}, {-1.0, 5.0}})
      mesh.positions.push_back(vertex(dem, c, r, z));
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  const MeasureReport report = measured(mesh, dem);
  EXPECT_EQ(report.worst->tinHeight, -5);
  EXPECT_EQ(report.worst->triangle, 3u);
  // The diagonal x + y = 4 is an edge of the three, so (2,2) is inside none of them.
  EXPECT_EQ(report.doublyCovered, 8u);
}

TEST(Measure, CountsCoveredNodata) {
  RasterHeightfield dem = raster(9, 7, slope);
  const TriangleMesh mesh = twoTriangles(dem);
  dem.heights[dem.index(2, 4)] = kNaN;  // inside a triangle
  dem.heights[dem.index(4, 3)] = kNaN;  // on the edge that both share
  dem.heights[dem.index(3, 0)] = kNaN;  // on the outer border: touched, not covered
  const MeasureReport report = measured(mesh, dem);
  EXPECT_EQ(report.valid, 60u);
  EXPECT_EQ(report.covered, 60u);
  EXPECT_EQ(report.nodataCovered, 2u);
  EXPECT_FALSE(keepsPromise(report, 1));
  EXPECT_TRUE(keepsPromise(report, 1, {.allowCoveredNodata = true}));
}

TEST(Measure, LeavesTheHolesOfTheFinestTriangulationUncovered) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 20; ++trial) {
    const RasterHeightfield dem = raster(13, 11, [&](double c, double r) {
      return random() % 10 < unsigned(trial) / 2 ? kNaN : std::sin(c) * 10 + r;
    });
    const MeasureReport report = measured(finest(dem), dem);
    EXPECT_EQ(report.valid, report.covered + report.isolated);
    EXPECT_EQ(report.uncovered, 0u);
    EXPECT_EQ(report.nodataCovered, 0u);
    EXPECT_EQ(report.overlapped, 0u);
    EXPECT_EQ(report.maxAbsError, 0);
    EXPECT_DOUBLE_EQ(report.tinAreaPixels, report.domainAreaPixels);
    EXPECT_TRUE(keepsPromise(report, 0));
  }
}

TEST(Measure, CountsIsolatedSamplesApart) {
  RasterHeightfield dem = raster(7, 7, [](double, double) { return kNaN; });
  for (const auto& [c, r] : {std::array{0u, 0u}, {1u, 0u}, {0u, 1u}}) dem.heights[dem.index(c, r)] = 10;
  dem.heights[dem.index(5, 5)] = 99;                                 // alone
  dem.heights[dem.index(3, 1)] = dem.heights[dem.index(4, 2)] = 50;  // a diagonal pair
  const MeasureReport report = measured(finest(dem), dem);
  EXPECT_EQ(report.samples, 49u);
  EXPECT_EQ(report.valid, 6u);
  EXPECT_EQ(report.covered, 3u);
  EXPECT_EQ(report.isolated, 3u);
  EXPECT_EQ(report.uncovered, 0u);
  EXPECT_EQ(report.maxAbsError, 0);

  // Covered by a wild triangle they are still in no statistic.
  TriangleMesh wild = finest(dem);
  for (const auto& [c, r] : {std::array{2.5, 6.5}, {6.5, 6.5}, {6.5, 2.5}})
    wild.positions.push_back(vertex(dem, c, r, 0));
  wild.triangles.push_back({49, 50, 51});
  EXPECT_EQ(measured(wild, dem).isolated, 3u);
  EXPECT_EQ(measured(wild, dem).maxAbsError, 0);
}

TEST(Measure, HoldsForAnyGeotransform) {
  const double angle = 0.3;
  const std::vector<std::array<double, 6>> transforms = {
      {0, 1, 0, 0, 0, -1},
      {376313.65545, 30, 0, 3807917.82763, 0, -30},  // UTM, north up
      {500000.123, 0.5, 0, 5000000.7, 0, 0.5},       // south up
      {326500.69, 2.5 * std::cos(angle), 2.5 * std::sin(angle), 5673789.7, 2.5 * std::sin(angle),
       -2.5 * std::cos(angle)},                                    // rotated
      {7.99958, 0.000833333333, 0, 47.00042, 0, -0.000833333333},  // degrees
      {1e7, 0.01, 0.002, -3e7, 0.001, -0.013},                     // sheared, far away
      {0, 0, 30, 0, 30, 0},                                        // transposed
  };
  for (const auto& transform : transforms) {
    RasterHeightfield dem = raster(41, 37, slope, transform);
    TriangleMesh coarse = twoTriangles(dem);
    dem.heights[dem.index(20, 7)] += 12.5;
    const MeasureReport report = measured(coarse, dem);
    EXPECT_EQ(report.covered, 41u * 37u);
    EXPECT_EQ(report.doublyCovered, 0u);
    EXPECT_EQ(report.overlapped, 0u);
    EXPECT_NEAR(report.maxAbsError, 12.5, 1e-9);
    EXPECT_EQ(report.worst->column, 20u);
    EXPECT_EQ(report.worst->row, 7u);
    EXPECT_NEAR(report.tinAreaPixels, 40 * 36, 1e-6);
    EXPECT_NEAR(report.worst->x, dem.georeference.toSource(20, 7).x, 0);

    std::mt19937 random(3);
    for (double& h : dem.heights) h = double(random() % 4000);
    dem.heights[100] = dem.heights[500] = kNaN;
    TriangleMesh full = finest(dem);
    for (std::size_t t = 0; t < full.triangles.size(); t += 3)
      std::swap(full.triangles[t][0], full.triangles[t][1]);
    const MeasureReport exact = measured(full, dem);
    EXPECT_EQ(exact.uncovered, 0u);
    EXPECT_EQ(exact.overlapped, 0u);
    EXPECT_EQ(exact.nodataCovered, 0u);
    EXPECT_EQ(exact.maxAbsError, 0);
  }
}

TEST(Measure, CoversSamplesOnEdgesAndVerticesDespiteRounding) {
  // A fan whose spokes pass exactly through samples, at coordinates that do not round well.
  const RasterHeightfield dem = raster(25, 25, slope, {376313.65545, 0.1, 0, 3807917.82763, 0, -0.1});
  TriangleMesh mesh;
  mesh.positions.push_back(vertex(dem, 12, 12, slope(12, 12)));
  const std::vector<std::array<double, 2>> rim = {{0, 0},   {6, 0},   {12, 0},  {18, 0}, {24, 0}, {24, 8},
                                                  {24, 16}, {24, 24}, {16, 24}, {8, 24}, {0, 24}, {0, 12}};
  for (const auto& [c, r] : rim) mesh.positions.push_back(vertex(dem, c, r, slope(c, r)));
  for (std::uint32_t i = 0; i < rim.size(); ++i)
    mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % std::uint32_t(rim.size())});
  const MeasureReport report = measured(mesh, dem);
  EXPECT_EQ(report.covered, 625u);
  EXPECT_EQ(report.doublyCovered, 0u);
  EXPECT_EQ(report.overlapped, 0u);
  EXPECT_LT(report.maxAbsError, 1e-9);
}

TEST(Measure, DrawsTheLineAtAMillionthOfAPixel) {
  const RasterHeightfield dem = raster(3, 3, [](double, double) { return 7.0; });
  const auto uncoveredWithGap = [&](double gap) {
    TriangleMesh mesh;
    mesh.positions = {vertex(dem, gap, -5, 7), vertex(dem, gap, 9, 7), vertex(dem, 30, 2, 7)};
    mesh.triangles = {{0, 1, 2}};
    return measured(mesh, dem).uncovered;
  };
  EXPECT_EQ(uncoveredWithGap(0), 0u);
  EXPECT_EQ(uncoveredWithGap(0.9e-6), 0u);
  EXPECT_EQ(uncoveredWithGap(1.1e-6), 3u);
  EXPECT_EQ(uncoveredWithGap(-1e-3), 0u);
}

TEST(Measure, TakesVerticesOfARoundedMeshToTheirSamples) {
  // Longitudes and latitudes that float32 cannot hold, on a slope that rounding would tilt.
  const double step = 1.0 / 1200;
  const auto dem = raster(200, 150, [](double c, double r) { return 40 * c - 25 * r; },
                          {8 - step / 2, step, 0, 47 + step / 2, 0, -step});
  TriangleMesh mesh = twoTriangles(dem);
  for (Vec3& p : mesh.positions) {
    p.x = 8.01 + static_cast<double>(static_cast<float>(p.x - 8.01));
    p.y = 46.9 + static_cast<double>(static_cast<float>(p.y - 46.9));
  }
  const auto plain = measure(mesh, dem);
  ASSERT_TRUE(plain);
  EXPECT_FALSE(keepsPromise(*plain, 0));
  const MeasureOptions options{.planRounding = {1e-8, 1e-8}};
  EXPECT_NEAR(planTolerancePixels(options, dem.georeference), 2.4e-5, 1e-9);
  const auto told = measure(mesh, dem, options);
  ASSERT_TRUE(told);
  EXPECT_EQ(told->uncovered, 0u);
  EXPECT_TRUE(keepsPromise(*told, 0));
  // However coarse the numbers, a pixel stays a pixel.
  EXPECT_EQ(planTolerancePixels({.planRounding = {1, 1}}, dem.georeference), kMostPlanTolerance);
  EXPECT_EQ(planTolerancePixels({}, dem.georeference), MeasureOptions().planTolerancePixels);
}

TEST(Measure, CoversARasterSoFarAwayThatDoublesRoundItsPlaces) {
  const auto dem =
      raster(260, 130, [](double c, double r) { return 3 * c + 2 * r; }, {1e9, 0.01, 0, -3e9, 0, -0.01});
  const auto report = measure(finest(dem), dem);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->uncovered, 0u);
  EXPECT_TRUE(keepsPromise(*report, 0));
  EXPECT_NEAR(planTolerancePixels({}, dem.georeference), 2.7e-4, 1e-5);
}

TEST(Measure, DoesNotStretchTheToleranceBeyondASharpCorner) {
  // The frame's mitre of this needle reaches 0.2 pixels past its tip; the sample there is not covered.
  const RasterHeightfield dem = raster(12, 3, [](double, double) { return 7.0; });
  TriangleMesh mesh;
  mesh.positions = {vertex(dem, 0, 1 - 2e-5, 7), vertex(dem, 0, 1 + 2e-5, 7), vertex(dem, 9.9, 1, 900)};
  mesh.triangles = {{0, 1, 2}};
  const MeasureReport report = measured(mesh, dem);
  EXPECT_EQ(report.covered, 10u);
  EXPECT_NEAR(report.maxAbsError, 893 * 9 / 9.9, 1e-6);
}

TEST(Measure, LetsDegenerateTrianglesCoverNothing) {
  const RasterHeightfield dem = raster(5, 5, slope, {376313.65545, 30, 0, 3807917.82763, 0, -30});
  TriangleMesh mesh;
  for (const auto& [c, r] :
       {std::array{0.0, 0.0}, {2.0, 2.0}, {4.0, 4.0}, {1.3, 0.1}, {1.3, 2.2}, {1.3, 3.9}})
    mesh.positions.push_back(vertex(dem, c, r, 1000));
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}, {0, 0, 1}, {2, 2, 2}};
  const MeasureReport report = measured(mesh, dem);
  EXPECT_EQ(report.degenerateTriangles, 4u);
  EXPECT_EQ(report.covered, 0u);
  EXPECT_EQ(report.uncovered, 25u);
  EXPECT_FALSE(report.worst);
  EXPECT_NEAR(report.tinAreaPixels, 0, 1e-6);
}

TEST(Measure, TakesAnEmptyMeshAndAnEmptyRaster) {
  const RasterHeightfield dem = raster(4, 4, slope);
  const MeasureReport report = measured({}, dem);
  EXPECT_EQ(report.uncovered, 16u);
  EXPECT_EQ(report.maxAbsError, 0);
  EXPECT_FALSE(keepsPromise(report, 1e9));

  const RasterHeightfield none = raster(0, 0, slope);
  EXPECT_EQ(measured(twoTriangles(dem), none).samples, 0u);
  EXPECT_EQ(measured({}, none).samples, 0u);
  EXPECT_EQ(measured(twoTriangles(dem), raster(1, 9, slope)).isolated, 9u);
}

TEST(Measure, TakesTrianglesFarOutsideTheRaster) {
  const RasterHeightfield dem = raster(6, 6, [](double, double) { return 0.0; });
  TriangleMesh mesh;
  mesh.positions = {vertex(dem, -1e6, -1e6, 0), vertex(dem, 3e6, -1e6, 0), vertex(dem, -1e6, 3e6, 0),
                    vertex(dem, 50, 2, 0),      vertex(dem, 60, 2, 0),     vertex(dem, 50, 9, 0),
                    vertex(dem, 2, -50, 0),     vertex(dem, 2.5, -60, 0),  vertex(dem, 4, -50, 0)};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}};
  const MeasureReport report = measured(mesh, dem);
  EXPECT_EQ(report.covered, 36u);
  EXPECT_EQ(report.doublyCovered, 0u);

  mesh.positions[0].x = 1e200;
  const auto refused = measure(mesh, dem);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::invalidData);
}

TEST(Measure, RefusesNonsense) {
  const RasterHeightfield dem = raster(4, 4, slope);
  TriangleMesh mesh = twoTriangles(dem);
  mesh.triangles.push_back({0, 1, 4});
  EXPECT_EQ(measure(mesh, dem).error().code, ErrorCode::invalidData);
  mesh = twoTriangles(dem);
  mesh.positions[1].y = kNaN;
  EXPECT_EQ(measure(mesh, dem).error().code, ErrorCode::invalidData);

  RasterHeightfield flat = dem;
  flat.georeference.geoTransform = {0, 1, 1, 0, 2, 2};
  EXPECT_FALSE(measure(twoTriangles(dem), flat));
  const std::vector<std::uint8_t> mask(3);
  EXPECT_EQ(measure(twoTriangles(dem), dem, {.mask = mask}).error().code, ErrorCode::usage);
  EXPECT_FALSE(measure(twoTriangles(dem), dem, {.planTolerancePixels = kNaN}));
}

TEST(Measure, StopsWhenAsked) {
  const RasterHeightfield dem = raster(4, 4, slope);
  const std::atomic<bool> stop = true;
  RunContext context;
  context.cancel = &stop;
  EXPECT_EQ(measure(twoTriangles(dem), dem, {}, context).error().code, ErrorCode::interrupted);
}

TEST(Measure, MeasuresInsideAMaskOnly) {
  RasterHeightfield dem = raster(9, 7, slope);
  const TriangleMesh mesh = twoTriangles(dem);
  dem.heights[dem.index(1, 1)] += 50;
  dem.heights[dem.index(7, 5)] += 5;
  std::vector<std::uint8_t> mask(dem.size());
  for (std::uint32_t r = 4; r < 7; ++r)
    for (std::uint32_t c = 5; c < 9; ++c) mask[dem.index(c, r)] = 1;
  const MeasureReport report = measured(mesh, dem, {.mask = mask});
  EXPECT_EQ(report.samples, 12u);
  EXPECT_EQ(report.covered, 12u);
  EXPECT_NEAR(report.maxAbsError, 5, 1e-12);
}

TEST(Measure, HandsBackTheSampledTinAndTheErrors) {
  RasterHeightfield dem = raster(9, 7, slope);
  TriangleMesh mesh = twoTriangles(dem);
  mesh.triangles.pop_back();
  dem.heights[dem.index(2, 4)] += 3;
  dem.heights[dem.index(1, 5)] = kNaN;
  MeasureRasters rasters;
  ASSERT_TRUE(measure(mesh, dem, {}, {}, &rasters));
  ASSERT_EQ(rasters.tinHeights.size(), 63u);
  ASSERT_EQ(rasters.errors.size(), 63u);
  EXPECT_NEAR(rasters.tinHeights[dem.index(2, 4)], slope(2, 4), 1e-12);
  EXPECT_NEAR(rasters.errors[dem.index(2, 4)], -3, 1e-12);
  EXPECT_NEAR(rasters.tinHeights[dem.index(1, 5)], slope(1, 5), 1e-12);
  EXPECT_TRUE(std::isnan(rasters.errors[dem.index(1, 5)]));
  EXPECT_TRUE(std::isnan(rasters.tinHeights[dem.index(8, 0)]));
  EXPECT_TRUE(std::isnan(rasters.errors[dem.index(8, 0)]));
}

TEST(Measure, AcceptsFourUlpOfTheHeightsThereAndNoMore) {
  for (const double base : {1.0, 100.0, 1e9, 1e20})
    for (const int ulps : {0, 3, 4, 5, 6}) {
      SCOPED_TRACE(testing::Message() << "base " << base << ", " << ulps << " ulp");
      const double ulp = std::nextafter(base, 2 * base) - base;
      RasterHeightfield dem = raster(3, 3, [&](double, double) { return base; });
      dem.heights[1] = base + (16 + ulps) * ulp;
      const MeasureReport report = measured(twoTriangles(dem), dem);
      EXPECT_EQ(report.maxAbsError, (16 + ulps) * ulp);
      EXPECT_EQ(keepsPromise(report, 16 * ulp), ulps <= 4);
      EXPECT_FALSE(keepsPromise(report, kNaN));
    }
  MeasureReport report;
  report.errorBeyondRounding = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(keepsPromise(report, 5));
}

TEST(Measure, ForgivesNothingBecauseAHeightElsewhereIsLarge) {
  RasterHeightfield dem =
      raster(9, 9, [](double column, double row) { return column + row == 0 ? 1e20 : 0; });
  const TriangleMesh mesh = finest(dem);
  dem.heights[70] = 1;
  EXPECT_TRUE(keepsPromise(measured(mesh, dem), 1));
  EXPECT_FALSE(keepsPromise(measured(mesh, dem), 1 - 1e-9));
}

TEST(Measure, IsNotMisledByTheRoundingOfLargeHeights) {
  // At a third of an edge that rises by 1, where doubles are 1/8 apart.
  RasterHeightfield dem = raster(4, 4, [](double column, double) { return 1e15 + column / 3; });
  dem.heights[1] = 1e15 - 10;
  EXPECT_NEAR(measured(twoTriangles(dem), dem).errorBeyondRounding, 10 + 1 / 3.0 - 4 * 0.125, 1e-9);
}

}  // namespace
}  // namespace arete
