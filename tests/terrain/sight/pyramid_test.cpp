// SPDX-License-Identifier: GPL-3.0-or-later
//
// The pyramid against the scan of every cell, and how much of the terrain it skips.
#include <gtest/gtest.h>

#include <cmath>

#include "datasets/random.h"
#include "terrain/sight/engine.h"

namespace arete::test {
namespace {

std::shared_ptr<const SightGrid> hills(std::uint32_t columns, std::uint32_t rows, Random& random,
                                       double voids) {
  std::vector<double> heights;
  for (std::uint32_t row = 0; row < rows; ++row)
    for (std::uint32_t column = 0; column < columns; ++column)
      heights.push_back(random.unit() < voids
                            ? std::nan("")
                            : 40 * std::sin(column * 0.07) * std::cos(row * 0.05) + random.between(0, 3));
  return std::make_shared<SightGrid>(columns, rows, heights);
}

SightLine lineBetween(Vec2 a, double from, Vec2 b, double to) {
  SightTrack track;
  track.points = {{a, 0}, {b, 10 * std::hypot(b.x - a.x, b.y - a.y)}};
  track.curvature = 1e-7;
  return SightLine(track, from, to);
}

TEST(SightPyramid, AnswersAsTheScanAtSizesAroundItsSquares) {
  constexpr std::uint64_t kSeed = 71;
  Random random(kSeed);
  for (const std::uint32_t columns : {2u, 8u, 9u, 10u, 33u, 130u})
    for (const std::uint32_t rows : {1u, 2u, 9u, 65u})
      for (const double voids : {0.0, 0.002}) {
        const auto grid = hills(columns, rows, random, voids);
        const auto pyramid = makeSightPyramid(grid);
        const auto scan = makeSightScan(grid);
        for (int i = 0; i < 60; ++i) {
          SCOPED_TRACE(testing::Message()
                       << "seed " << kSeed << ", " << columns << " x " << rows << ", " << i);
          const auto anywhere = [&] { return Vec2{random.between(-1, columns), random.between(-1, rows)}; };
          const SightLine line =
              lineBetween(anywhere(), random.between(0, 60), anywhere(), random.between(0, 60));
          const SightOptions options{.nodata = static_cast<NodataSight>(i % 3), .wantsClearance = i % 2 == 0};
          const SightAnswer a = pyramid->answer(line, options), b = scan->answer(line, options);
          EXPECT_EQ(a.verdict, b.verdict);
          ASSERT_EQ(a.clearance.has_value(), b.clearance.has_value());
          if (a.clearance) {
            EXPECT_NEAR(*a.clearance, *b.clearance, 1e-9);
          }
          ASSERT_EQ(a.obstruction.has_value(), b.obstruction.has_value());
          if (a.obstruction) {
            EXPECT_NEAR(a.obstruction->distance, b.obstruction->distance, 1e-6);
          }
        }
      }
}

TEST(SightPyramid, SkipsTerrainFarBelowTheLine) {
  Random random(72);
  const auto grid = hills(1000, 1000, random, 0);
  const SightLine line = lineBetween({3, 5}, 500, {990, 980}, 500);
  const SightAnswer quick = makeSightPyramid(grid)->answer(line, {.wantsClearance = false});
  const SightAnswer whole = makeSightScan(grid)->answer(line, {.wantsClearance = false});
  EXPECT_EQ(quick.verdict, SightVerdict::visible);
  EXPECT_GT(whole.visited, 1000u);
  EXPECT_LT(quick.visited, 10u);
}

}  // namespace
}  // namespace arete::test
