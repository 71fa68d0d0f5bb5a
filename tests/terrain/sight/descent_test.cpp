// SPDX-License-Identifier: GPL-3.0-or-later
//
// The descent with a tolerance, against its own answers at full resolution, which engine_test.cpp compares
// with the oracle.
#include <gtest/gtest.h>

#include <cmath>

#include "datasets/families.h"
#include "datasets/random.h"
#include "terrain/builder/build.h"
#include "terrain/sight/engine.h"

namespace arete::test {
namespace {

TEST(SightDescent, WithinAToleranceTheClearanceIsAsNearAsItSays) {
  constexpr std::uint64_t kSeed = 91;
  Random random(kSeed);
  const auto model = build(rasterFamilies()[3].make(65, 50, 7));
  ASSERT_TRUE(model);
  const auto descent = makeSightDescent(*model);
  const SightGrid grid(*model);
  std::uint64_t undecided = 0, fewer = 0;
  for (int i = 0; i < 1500; ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", line " << i);
    const Vec2 a{random.between(0, 64), random.between(0, 49)},
        b{random.between(0, 64), random.between(0, 49)};
    SightTrack track;
    track.points = {{a, 0}, {b, 30 * std::hypot(b.x - a.x, b.y - a.y)}};
    const SightLine line(track, grid.at(a) + random.between(0, 20), grid.at(b) + random.between(0, 20));
    const double maxError = std::pow(10.0, random.between(-1, 2));
    const SightAnswer exact = descent->answer(line, {}),
                      coarse = descent->answer(line, {.maxError = maxError});
    ASSERT_EQ(exact.clearance.has_value(), coarse.clearance.has_value());
    EXPECT_EQ(exact.clearanceWithin, 0);
    if (exact.clearance) {
      EXPECT_LE(coarse.clearanceWithin, maxError);
      EXPECT_LE(std::fabs(*exact.clearance - *coarse.clearance), coarse.clearanceWithin + 1e-6);
    }
    if (coarse.verdict == SightVerdict::undecided) {
      ++undecided;
    } else {
      EXPECT_EQ(coarse.verdict, exact.verdict);
    }
    fewer += coarse.visited < exact.visited;
  }
  EXPECT_GT(undecided, 10u);
  EXPECT_GT(fewer, 500u);
}

TEST(SightDescent, WithinAToleranceSaysWhichObstructionMayNotBeTheFirst) {
  // Over a lake among hills coarse triangles are exact, and they lie beside such as are not.
  constexpr std::uint32_t kSide = 65;
  RasterHeightfield field;
  field.columns = field.rows = kSide;
  for (std::uint32_t row = 0; row < kSide; ++row)
    for (std::uint32_t column = 0; column < kSide; ++column)
      field.heights.push_back(std::max(0.0, 40 * std::sin(column * 0.13) * std::cos(row * 0.11) - 28));
  const auto model = build(field);
  ASSERT_TRUE(model);
  const auto descent = makeSightDescent(*model);
  Random random(11);
  const auto place = [&] { return Vec2{random.between(0, kSide - 1), random.between(0, kSide - 1)}; };
  int firsts = 0, later = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec2 from = place(), to = place();
    SightTrack track;
    track.points = {{from, 0}, {to, 30 * std::hypot(to.x - from.x, to.y - from.y)}};
    track.curvature = 2e-5;
    const SightLine line(track, random.between(5, 15), random.between(5, 15));
    const SightAnswer exact = descent->answer(line, {});
    for (const double maxError : {0.1, 1.0, 5.0}) {
      const SightAnswer coarse = descent->answer(line, {.maxError = maxError});
      if (!coarse.obstruction) continue;
      ASSERT_TRUE(exact.obstruction) << i;
      const double first = exact.obstruction->distance, told = coarse.obstruction->distance;
      EXPECT_LE(first, told + 1e-6) << i << " within " << maxError;
      if (!coarse.isObstructionLatest) {
        EXPECT_NEAR(first, told, 1e-6) << i << " within " << maxError;
      }
      ++(coarse.isObstructionLatest ? later : firsts);
    }
  }
  EXPECT_GT(firsts, 50);
  EXPECT_GT(later, 50);
}

}  // namespace
}  // namespace arete::test
