// SPDX-License-Identifier: GPL-3.0-or-later
//
// The measurement against an oracle: every sample against every triangle, in long double and with other
// formulas.
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

namespace arete {
namespace {

using namespace measuring_test;

struct OracleHit {
  bool covers = false, strict = false;
  long double z = 0, turn = 0;
};

OracleHit meet(const std::array<Vec3, 3>& corners, long double x, long double y) {
  using Real = long double;
  constexpr Real kTolerance = 1e-6L;
  const auto cross = [](Real ax, Real ay, Real bx, Real by) { return ax * by - ay * bx; };
  const auto& [a, b, c] = corners;
  const Real area = cross(Real(b.x) - a.x, Real(b.y) - a.y, Real(c.x) - a.x, Real(c.y) - a.y);
  OracleHit hit;
  const Real longest =
      std::max({std::hypot(Real(b.x) - a.x, Real(b.y) - a.y), std::hypot(Real(c.x) - b.x, Real(c.y) - b.y),
                std::hypot(Real(a.x) - c.x, Real(a.y) - c.y)});
  if (std::abs(area) <= kTolerance * longest) return hit;
  const Real u = cross(x - a.x, y - a.y, Real(c.x) - a.x, Real(c.y) - a.y) / area;
  const Real v = cross(Real(b.x) - a.x, Real(b.y) - a.y, x - a.x, y - a.y) / area;
  hit.z = a.z + u * (Real(b.z) - a.z) + v * (Real(c.z) - a.z);
  Real toRim = std::numeric_limits<Real>::infinity();
  int cornerAt = -1, sides = 0;
  for (int i = 0; i < 3; ++i) {
    const Vec3 &p = corners[i], &q = corners[(i + 1) % 3];
    const Real dx = Real(q.x) - p.x, dy = Real(q.y) - p.y;
    const Real t = std::clamp(((x - p.x) * dx + (y - p.y) * dy) / (dx * dx + dy * dy), Real(0), Real(1));
    sides += std::abs(cross(dx, dy, x - p.x, y - p.y)) <= kTolerance * std::hypot(dx, dy);
    toRim = std::min(toRim, std::hypot(p.x + t * dx - x, p.y + t * dy - y));
    if (std::hypot(p.x - x, p.y - y) <= kTolerance) cornerAt = i;
  }
  const bool inside = u >= 0 && v >= 0 && u + v <= 1;
  hit.covers = inside || toRim <= kTolerance;
  hit.strict = inside && toRim > kTolerance;
  if (hit.strict) {
    hit.turn = 2 * std::numbers::pi_v<Real>;
  } else if (cornerAt >= 0) {
    const Vec3 &p = corners[cornerAt], &q = corners[(cornerAt + 1) % 3], &r = corners[(cornerAt + 2) % 3];
    const Real qx = Real(q.x) - p.x, qy = Real(q.y) - p.y, rx = Real(r.x) - p.x, ry = Real(r.y) - p.y;
    hit.turn = std::abs(std::atan2(cross(qx, qy, rx, ry), qx * rx + qy * ry));
  } else if (hit.covers && sides == 1) {
    hit.turn = std::numbers::pi_v<Real>;
  }
  return hit;
}

struct OracleSample {
  bool covered = false, interior = false, overlapped = false;
  int strict = 0;
  long double error = 0;  ///< the largest
};

/// Triangles and sample in one frame, in pixels.
OracleSample sampleByForce(const TriangleMesh& mesh, double x, double y, double height) {
  OracleSample sample;
  long double turn = 0;
  for (const auto& t : mesh.triangles) {
    const OracleHit hit = meet({mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]}, x, y);
    sample.covered |= hit.covers;
    sample.strict += hit.strict;
    turn += hit.turn;
    if (hit.covers) sample.error = std::max(sample.error, std::abs(hit.z - height));
  }
  constexpr long double kTurn = 2 * std::numbers::pi_v<long double>;
  sample.interior = turn > kTurn - 1e-2L;
  sample.overlapped = turn > kTurn + 1e-2L;
  return sample;
}

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

/// A conforming TIN with random vertices: triangles split at random inner points.
TriangleMesh randomTin(std::mt19937& random, double width, double height, int splits, bool onSamples) {
  TriangleMesh mesh;
  std::uniform_real_distribution<double> unit(0.05, 0.95), z(0, 500);
  mesh.positions = {
      {0, 0, z(random)}, {width, 0, z(random)}, {width, height, z(random)}, {0, height, z(random)}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  for (int s = 0; s < splits; ++s) {
    const std::size_t pick = random() % mesh.triangles.size();
    const auto t = mesh.triangles[pick];
    double u = unit(random), v = unit(random) * (1 - u);
    const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
    Vec3 p{a.x + u * (b.x - a.x) + v * (c.x - a.x), a.y + u * (b.y - a.y) + v * (c.y - a.y), z(random)};
    if (onSamples) {
      p.x = std::round(p.x);
      p.y = std::round(p.y);
      const auto side = [&p](const Vec3& f, const Vec3& g) {
        return (g.x - f.x) * (p.y - f.y) - (g.y - f.y) * (p.x - f.x);
      };
      if (side(a, b) <= 0 || side(b, c) <= 0 || side(c, a) <= 0) continue;
    }
    const auto n = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.push_back(p);
    mesh.triangles[pick] = {t[0], t[1], n};
    mesh.triangles.push_back({t[1], t[2], n});
    mesh.triangles.push_back({t[2], t[0], n});
  }
  return mesh;
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

TEST(MeasurePoints, FindsAPlantedErrorAndAnUncoveredPoint) {
  PointHeightfield points;
  points.positions = {{500000, 5000000}, {500010, 5000000}, {500000, 5000010},
                      {500002, 5000003}, {500009, 5000009}, {500005, 5000005}};
  points.heights = {1, 2, 3, 7, 5, 2.5};
  TriangleMesh mesh;
  mesh.positions = {{500000, 5000000, 1}, {500010, 5000000, 2}, {500000, 5000010, 3}};
  mesh.triangles = {{0, 2, 1}};
  const Result<MeasureReport> report = measure(mesh, points);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->samples, 6u);
  EXPECT_EQ(report->covered, 5u);
  EXPECT_EQ(report->uncovered, 1u);
  EXPECT_EQ(report->isolated, 0u);
  EXPECT_EQ(report->worst->sample, 3u);
  EXPECT_EQ(report->worst->x, 500002);
  EXPECT_NEAR(report->worst->tinHeight, 1.8, 1e-9);
  EXPECT_NEAR(report->maxAbsError, 5.2, 1e-9);
}

TEST(MeasurePoints, AgreesWithBruteForce) {
  std::mt19937 random(21);
  std::uniform_real_distribution<double> unit(0, 1), height(0, 500);
  for (int trial = 0; trial < 40; ++trial) {
    // A square whose mean spacing is 1, so that a pixel of the oracle is one of the measurement.
    const int n = 50 + trial * 20;
    const double side = std::sqrt(double(n));
    TriangleMesh mesh = randomTin(random, side, side, trial, false);
    if (trial % 3 == 1) mesh.triangles.pop_back();
    if (trial % 3 == 2) mesh.triangles.push_back({0, 1, 3});
    PointHeightfield points;
    for (const Vec3& p : mesh.positions) points.positions.push_back({p.x, p.y});
    while (points.positions.size() < std::size_t(n))
      points.positions.push_back({unit(random) * side, unit(random) * side});
    for (std::size_t i = 0; i < points.positions.size(); ++i) points.heights.push_back(height(random));

    MeasureReport expected;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const OracleSample s =
          sampleByForce(mesh, points.positions[i].x, points.positions[i].y, points.heights[i]);
      expected.covered += s.covered;
      expected.doublyCovered += s.strict > 1;
      expected.overlapped += s.overlapped;
      expected.maxAbsError = std::max(expected.maxAbsError, double(s.error));
    }
    SCOPED_TRACE(trial);
    for (const int threads : {1, 3}) {
      RunContext context;
      context.threads = threads;
      const Result<MeasureReport> report = measure(mesh, points, {}, context);
      ASSERT_TRUE(report);
      EXPECT_EQ(report->covered, expected.covered);
      EXPECT_EQ(report->doublyCovered, expected.doublyCovered);
      EXPECT_EQ(report->overlapped, expected.overlapped);
      EXPECT_NEAR(report->maxAbsError, expected.maxAbsError, 1e-6);
    }
  }
}

TEST(MeasurePoints, TakesDegenerateClouds) {
  TriangleMesh mesh;
  mesh.positions = {{-1, -1, 0}, {100, -1, 0}, {-1, 100, 0}};
  mesh.triangles = {{0, 1, 2}};
  PointHeightfield points;
  EXPECT_EQ(measure(mesh, points)->samples, 0u);
  points.positions = {{3, 3}};
  points.heights = {5};
  EXPECT_EQ(measure(mesh, points)->maxAbsError, 5);
  for (int i = 0; i < 40; ++i) {
    points.positions.push_back({i * 0.5, 3});
    points.heights.push_back(i);
  }
  EXPECT_EQ(measure(mesh, points)->covered, 41u);
  EXPECT_EQ(measure({}, points)->uncovered, 41u);
  points.positions[0] = {1e308, 3};
  points.positions[1] = {-1e308, 3};
  EXPECT_FALSE(measure(mesh, points));
}

}  // namespace
}  // namespace arete
