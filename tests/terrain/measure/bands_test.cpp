// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bands against a test of every triangle with every band; totals of parts against those of the whole.
#include "terrain/measure/bands.h"

#include "engine/parallel/each_task.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace arete::measuring {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(TriangleBands, ListTheTrianglesWithinTwiceTheToleranceOfEachBandInOrder) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> anywhere(-20, 60), tall(-5, 5);
    TriangleMesh mesh;
    std::vector<Vec2> plan;
    for (std::uint32_t t = 0; t < 500; ++t) {
      const double y = std::round(anywhere(random) * 4) / 4;
      const double x = anywhere(random);
      plan.insert(plan.end(), {{x, y}, {x + 1, y + tall(random)}, {x + tall(random), y + tall(random)}});
      if (t % 7 == 0) plan.back() = plan[plan.size() - 2];  // without area
      mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    mesh.positions.resize(plan.size());
    constexpr std::int64_t kRows = 31, kRowsPerBand = 4;
    constexpr double kRowHeight = 1.5, kTolerance = 0.01;
    for (const bool keepsThin : {false, true}) {
      const TriangleBands bands =
          sortIntoBands(mesh, plan, kRows, kRowHeight, kRowsPerBand, kTolerance, keepsThin);
      ASSERT_EQ(bands.count(), 8u);
      PlanTriangle triangle;
      double area = 0;
      std::uint64_t degenerate = 0;
      std::vector<std::vector<std::uint32_t>> expected(bands.count());
      for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const bool hasArea = setTriangle(triangle, mesh, plan, t, kTolerance);
        area += triangle.area2 / 2;
        degenerate += hasArea ? 0 : 1;
        if (!hasArea && !keepsThin) continue;
        const auto [low, high] = std::minmax({plan[3 * t].y, plan[3 * t + 1].y, plan[3 * t + 2].y});
        for (std::int64_t row = 0; row < kRows; ++row)
          if (low - 2 * kTolerance < double(row + 1) * kRowHeight &&
              high + 2 * kTolerance >= double(row) * kRowHeight) {
            std::vector<std::uint32_t>& list = expected[std::size_t(row / kRowsPerBand)];
            if (list.empty() || list.back() != t) list.push_back(t);
          }
      }
      EXPECT_EQ(bands.degenerate, degenerate);
      EXPECT_GE(degenerate, 70u);
      EXPECT_EQ(bands.areaPixels, area);
      for (std::size_t b = 0; b < bands.count(); ++b)
        EXPECT_TRUE(std::ranges::equal(bands.of(b), expected[b])) << "band " << b;
    }
  }
  EXPECT_EQ(sortIntoBands({}, {}, 0, 1, 8, 1e-6).count(), 0u);
}

TEST(Gathered, KeepsTheLargestErrorAndCountsTurns) {
  Gathered gathered(3);
  EXPECT_FALSE(gathered.isCovered(0));
  gathered.add(0, 10, 4, 12, true, kFullTurn);
  gathered.add(0, 10, 5, 7, true, kFullTurn);
  gathered.add(0, 10, 6, 11, false, 0);
  EXPECT_EQ(gathered.z(0), 7);
  EXPECT_EQ(gathered.triangle(0), 5u);
  EXPECT_TRUE(gathered.isDoublyCovered(0));
  EXPECT_TRUE(gathered.isOverlapped(0));

  // Two halves fill the turn; a third one overlaps.
  gathered.add(1, kNaN, 0, 1, false, kHalfTurn);
  EXPECT_FALSE(gathered.isInterior(1));
  gathered.add(1, kNaN, 1, 1, false, kHalfTurn);
  EXPECT_TRUE(gathered.isInterior(1));
  EXPECT_FALSE(gathered.isOverlapped(1));
  gathered.add(1, kNaN, 2, 1, false, kHalfTurn);
  EXPECT_TRUE(gathered.isOverlapped(1));
  EXPECT_FALSE(gathered.isDoublyCovered(1));
  EXPECT_FALSE(gathered.isCovered(2));
}

TEST(BandTotals, KeepAnErrorThatIsNoNumberWhateverComesAfter) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const std::size_t place : {0u, 1u, 2u}) {
    BandTotals all;
    for (std::size_t i = 0; i < 3; ++i) {
      BandTotals band;
      band.counts.errorBeyondRounding = i == place ? nan : double(i);
      all.add(band);
    }
    EXPECT_TRUE(std::isnan(all.counts.errorBeyondRounding)) << place;
  }
}

TEST(BandTotals, OfBandsAddUpToThoseOfAllSamplesInAnyOrder) {
  std::mt19937 random(4);
  std::vector<MeasuredSample> samples;
  for (std::uint64_t i = 0; i < 1000; ++i)
    samples.push_back({i, 0, 0, 0, 0, double(random() % 64), double(random() % 64), std::uint32_t(i)});
  const auto worst = std::ranges::max_element(
      samples, {}, [](const MeasuredSample& s) { return std::pair(std::abs(s.error()), -double(s.sample)); });
  BandTotals all;
  for (const unsigned part : {2u, 0u, 3u, 1u}) {
    BandTotals band;
    std::vector<MeasuredSample> own;
    for (const MeasuredSample& s : samples)
      if (s.sample % 4 == part) own.push_back(s);
    std::ranges::shuffle(own, random);
    for (const MeasuredSample& s : own) band.addMeasured(s);
    all.add(band);
  }
  const MeasureReport report = all.finish();
  // Whole numbers: every sum is exact.
  double sum = 0, sumAbs = 0, squares = 0;
  for (const MeasuredSample& s : samples) {
    sum += s.error();
    sumAbs += std::abs(s.error());
    squares += s.error() * s.error();
  }
  EXPECT_EQ(report.covered, 1000u);
  EXPECT_EQ(report.meanError, sum / 1000);
  EXPECT_EQ(report.meanAbsError, sumAbs / 1000);
  EXPECT_EQ(report.rmsError, std::sqrt(squares / 1000));
  EXPECT_EQ(report.maxAbsError, std::abs(worst->error()));
  ASSERT_TRUE(report.worst);
  EXPECT_EQ(report.worst->sample, worst->sample) << "the first in sample order among equal errors";
  EXPECT_EQ(BandTotals{}.finish().rmsError, 0);
}

TEST(SampleRecorder, FillsTheRastersAndAppliesTheMask) {
  const std::vector<std::uint8_t> mask = {1, 0, 1};
  const MeasureOptions options{.mask = mask};
  const RunContext context;
  const TriangleMesh mesh{.positions = {{0, 0, 5}, {1, 0, 5}, {0, 1, 5}}, .triangles = {{0, 1, 2}}};
  const auto plan = [&](std::uint32_t v) { return Vec2{mesh.positions[v].x, mesh.positions[v].y}; };
  MeasureRasters rasters;
  const Inputs in{mesh, options, context, &rasters};
  SampleRecorder recorder(in, 3);
  BandTotals totals;
  EXPECT_TRUE(recorder.begin(0, 5));
  recorder.add({.sample = 0, .demHeight = 3, .tinHeight = 5}, {0, 0}, plan, totals);
  EXPECT_FALSE(recorder.begin(1, 6));
  EXPECT_TRUE(recorder.begin(2, kNaN));
  EXPECT_EQ(rasters.tinHeights[0], 5);
  EXPECT_EQ(rasters.tinHeights[1], 6);
  EXPECT_TRUE(std::isnan(rasters.tinHeights[2]));
  EXPECT_EQ(rasters.errors[0], 2);
  EXPECT_TRUE(std::isnan(rasters.errors[1]) && std::isnan(rasters.errors[2]));
  EXPECT_EQ(totals.counts.covered, 1u);
  EXPECT_EQ(totals.counts.errorBeyondRounding, 2 - 4 * 0x1p-50);
}

TEST(Bands, RunEachOnceAndStopWhenCancelled) {
  for (const int threads : {1, 3}) {
    RunContext context;
    context.threads = threads;
    std::vector<std::atomic<int>> runs(100);
    ASSERT_TRUE(forEachTask(runs.size(), context, "testing", [&](std::size_t band) { ++runs[band]; }));
    EXPECT_TRUE(std::ranges::all_of(runs, [](const auto& count) { return count == 1; }));
  }
  const std::atomic<bool> cancel = true;
  RunContext context;
  context.cancel = &cancel;
  const Status stopped = forEachTask(5, context, "testing", [](std::size_t) { FAIL(); });
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::interrupted);
}

TEST(MeasureInputs, NameTheFieldThatIsOutOfRange) {
  const TriangleMesh mesh;
  const RunContext context;
  const auto refused = [&](const MeasureOptions& options) {
    const Status status = checkInputs({mesh, options, context, nullptr}, {}, 7);
    EXPECT_FALSE(status);
    return status ? Error{} : status.error();
  };
  const std::vector<std::uint8_t> mask(6);
  EXPECT_EQ(refused({.mask = mask}).culprit, "mask");
  for (const double tolerance : {0.0, -1.0, 0.25, kNaN}) {
    const Error error = refused({.planTolerancePixels = tolerance});
    EXPECT_EQ(error.culprit, "planTolerancePixels");
    EXPECT_EQ(error.code, ErrorCode::usage);
  }
  EXPECT_TRUE(checkInputs({mesh, {}, context, nullptr}, {}, 7));
}

TEST(MeasureInputs, RaiseTheToleranceForRoundingUpToALimit) {
  const MeasureOptions options{.planTolerancePixels = 1e-3};
  EXPECT_EQ(raisedTolerance(options, {0, 0}), 1e-3);
  EXPECT_EQ(raisedTolerance(options, {1e-4, -2e-4}), 1e-3);
  EXPECT_EQ(raisedTolerance(options, {1e-4, -2e-3}), 4e-3);
  EXPECT_EQ(raisedTolerance(options, {5, 0}), kMostPlanTolerance);
}

}  // namespace
}  // namespace arete::measuring
