// SPDX-License-Identifier: GPL-3.0-or-later
//
// The measurement on rasters against the oracle of measure_oracle.h.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "terrain/measure/measure.h"
#include "terrain/measure_fixture.h"
#include "terrain/measure_oracle.h"

namespace arete {
namespace {

using namespace measuring_test;

void compareWithOracle(const RasterHeightfield& dem, const TriangleMesh& grid) {
  TriangleMesh mesh = grid;
  for (Vec3& p : mesh.positions) p = vertex(dem, p.x, p.y, p.z);
  MeasureReport expected;
  long double sum = 0;
  for (std::uint32_t r = 0; r < dem.rows; ++r) {
    for (std::uint32_t c = 0; c < dem.columns; ++c) {
      const double h = dem.at(c, r);
      const OracleSample sample = sampleByForce(grid, c, r, h);
      expected.doublyCovered += sample.strict > 1;
      expected.overlapped += sample.overlapped;
      if (std::isnan(h)) {
        expected.nodataCovered += sample.interior;
        continue;
      }
      ++expected.valid;
      expected.covered += sample.covered;
      if (!sample.covered) continue;
      sum += sample.error;
      expected.maxAbsError = std::max(expected.maxAbsError, double(sample.error));
    }
  }
  const MeasureReport report = measured(mesh, dem);
  ASSERT_EQ(report.isolated, 0u) << "the rasters of this test have no isolated sample";
  EXPECT_EQ(report.valid, expected.valid);
  EXPECT_EQ(report.covered, expected.covered);
  EXPECT_EQ(report.uncovered, expected.valid - expected.covered);
  EXPECT_EQ(report.doublyCovered, expected.doublyCovered);
  EXPECT_EQ(report.overlapped, expected.overlapped);
  EXPECT_EQ(report.nodataCovered, expected.nodataCovered);
  EXPECT_NEAR(report.maxAbsError, expected.maxAbsError, 1e-6);
  EXPECT_NEAR(report.meanAbsError, double(sum) / std::max(1.0, double(report.covered)), 1e-6);
}

TEST(Measure, AgreesWithBruteForceOnRandomTriangles) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> plan(-8, 38), height(0, 500);
  for (int trial = 0; trial < 60; ++trial) {
    const bool onSamples = trial % 2 == 0;
    const RasterHeightfield dem =
        raster(31, 23,
               [&](double c, double r) { return int(c) % 7 == 3 && int(r) % 5 == 2 ? kNaN : height(random); },
               {376313.65545, 29, 3, 3807917.82763, 2, -31});
    TriangleMesh mesh;
    const int triangles = 1 + trial % 9;
    for (int t = 0; t < triangles; ++t) {
      for (int i = 0; i < 3; ++i) {
        const double x = plan(random), y = plan(random);
        mesh.positions.push_back(
            {onSamples ? std::round(x) : x, onSamples ? std::round(y) : y, height(random)});
      }
      mesh.triangles.push_back({3u * t, 3u * t + 1, 3u * t + 2});
    }
    SCOPED_TRACE(trial);
    compareWithOracle(dem, mesh);
  }
}

TEST(Measure, AgreesWithBruteForceOnRandomTins) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> height(0, 500);
  for (int trial = 0; trial < 40; ++trial) {
    const RasterHeightfield dem = raster(37, 29, [&](double, double) { return height(random); },
                                         {7.99958, 0.000833333333, 0, 47.00042, 0, -0.000833333333});
    const TriangleMesh mesh = randomTin(random, 36, 28, 1 + trial * 2, trial % 2 == 0);
    SCOPED_TRACE(trial);
    compareWithOracle(dem, mesh);
    TriangleMesh source = mesh;
    for (Vec3& p : source.positions) p = vertex(dem, p.x, p.y, p.z);
    const MeasureReport report = measured(source, dem);
    EXPECT_EQ(report.covered, 37u * 29u);
    EXPECT_EQ(report.overlapped, 0u);
    EXPECT_NEAR(report.tinAreaPixels, 36 * 28, 1e-6);
  }
}

TEST(Measure, GivesTheSameBitsForAnyNumberOfThreads) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> height(0, 500);
  const RasterHeightfield dem = raster(700, 900, [&](double, double) { return height(random); });
  TriangleMesh mesh = randomTin(random, 699, 899, 3000, false);
  for (Vec3& p : mesh.positions) p = vertex(dem, p.x, p.y, p.z);
  std::optional<MeasureReport> first;
  for (const int threads : {1, 2, 3, 8}) {
    RunContext context;
    context.threads = threads;
    double last = 0;
    context.progress = [&](std::string_view, double fraction) {
      EXPECT_GE(fraction, last);
      last = fraction;
    };
    const Result<MeasureReport> report = measure(mesh, dem, {}, context);
    ASSERT_TRUE(report);
    EXPECT_EQ(last, 1);
    if (!first) first = *report;
    EXPECT_EQ(report->rmsError, first->rmsError);
    EXPECT_EQ(report->meanError, first->meanError);
    EXPECT_EQ(report->meanAbsError, first->meanAbsError);
    EXPECT_EQ(report->maxAbsError, first->maxAbsError);
    EXPECT_EQ(report->worst->sample, first->worst->sample);
    EXPECT_EQ(report->worst->triangle, first->worst->triangle);
    EXPECT_EQ(report->covered, 700u * 900u);
  }
}

}  // namespace
}  // namespace arete
