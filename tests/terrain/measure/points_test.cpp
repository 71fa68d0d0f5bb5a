// SPDX-License-Identifier: GPL-3.0-or-later
//
// measure() over scattered points: slivers, tolerances and degenerate sets, and an oracle (measure_oracle.h).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "terrain/measure/measure.h"
#include "terrain/measure_oracle.h"

namespace arete {
namespace {

using namespace measuring_test;

/// A row of points that is a billionth of its length from straight, over a triangle that is not thin.
struct Row {
  PointHeightfield points;
  TriangleMesh mesh;

  Row() {
    mesh.positions = {{0, 0, 0}, {10, 0, 0}, {5, 1e-9, 100}, {5, -3, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 3, 1}};
    for (const Vec3& p : mesh.positions) add(p.x, p.y, p.z);
  }
  void add(double x, double y, double z) {
    points.positions.push_back({x, y});
    points.heights.push_back(z);
  }
};

TEST(MeasurePoints, JudgesAPointInASliverByTheSliverAndNotByItsNeighbour) {
  Row row;
  row.add(3, 3e-10, 50);
  const Result<MeasureReport> report = measure(row.mesh, row.points);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->degenerateTriangles, 1u);
  EXPECT_EQ(report->covered, 5u);
  EXPECT_EQ(report->overlapped, 0u);
  ASSERT_TRUE(report->worst);
  EXPECT_EQ(report->worst->sample, 4u);
  EXPECT_EQ(report->worst->triangle, 0u);
  EXPECT_NEAR(report->worst->tinHeight, 30, 1e-9);
  EXPECT_TRUE(keepsPromise(*report, 20));
  EXPECT_FALSE(keepsPromise(*report, 19.99));
}

TEST(MeasurePoints, FindsAnErrorInASliverThatItsNeighbourWouldHide) {
  Row row;
  row.points.heights[2] = 0;  // what the triangle beside the sliver says
  const Result<MeasureReport> report = measure(row.mesh, row.points);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->maxAbsError, 100);
}

TEST(MeasurePoints, TakesTheLargestErrorOfAllTrianglesThatHoldAPoint) {
  Row row;
  row.mesh.positions.insert(row.mesh.positions.end(), {{0, 1, 7}, {10, 1, 7}, {5, -4, 7}});
  row.mesh.triangles.push_back({4, 6, 5});
  const Result<MeasureReport> report = measure(row.mesh, row.points);
  ASSERT_TRUE(report);
  EXPECT_GT(report->overlapped, 0u);
  EXPECT_EQ(report->maxAbsError, 93);
  EXPECT_FALSE(keepsPromise(*report, 1000));
}

TEST(MeasurePoints, TakesAPointThatNoTriangleHoldsToTheNearestWithinTheTolerance) {
  Row row;
  row.add(5, -3 - 1e-7, 4);
  row.add(5, -3 - 1e-4, 4);
  const Result<MeasureReport> report = measure(row.mesh, row.points);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->covered, 5u);
  EXPECT_EQ(report->uncovered, 1u);
  EXPECT_NEAR(report->maxAbsError, 4, 1e-9);
}

TEST(MeasurePoints, SeesNoSliversInAMeshWhosePlacesAreRounded) {
  const Row row;
  const Result<MeasureReport> report = measure(row.mesh, row.points, {.planRounding = {1e-8, 1e-8}});
  ASSERT_TRUE(report);
  EXPECT_EQ(report->covered, 4u);
  EXPECT_EQ(report->maxAbsError, 100);
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
