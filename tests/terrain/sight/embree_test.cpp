// SPDX-License-Identifier: GPL-3.0-or-later
//
// Embree's verdicts against those of the scan of every cell, for lines near the terrain, beyond its border,
// and so high or long that single precision is not enough.
#include <gtest/gtest.h>

#include <cmath>

#include "datasets/families.h"
#include "datasets/random.h"
#include "terrain/builder/build.h"
#include "terrain/sight/engine.h"

namespace arete::test {
namespace {

TEST(SightEmbree, VerdictsAreThoseOfTheScan) {
  constexpr std::uint64_t kSeed = 81;
  Random random(kSeed);
  std::uint64_t visible = 0, blocked = 0;
  for (const std::size_t family : {1u, 3u, 6u}) {
    const RasterHeightfield field = rasterFamilies()[family].make(60, 50, 4);
    const auto model = build(field);
    ASSERT_TRUE(model);
    const auto grid = std::make_shared<SightGrid>(*model);
    const auto scan = makeSightScan(grid);
    const auto embree = makeSightEmbree(*model);
    for (int i = 0; i < 1500; ++i) {
      SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", family " << family << ", line " << i);
      const double margin = i % 10 == 0 ? -4 : 0.5;
      const auto anywhere = [&] {
        return Vec2{random.between(margin, 59 - margin), random.between(margin, 49 - margin)};
      };
      const auto heightAt = [&](Vec2 p) {
        const double z = grid->at(p);
        const double above = i % 50 == 1 ? 1e7 : random.between(0, random.below(2) == 0 ? 3 : 60);
        return (std::isnan(z) ? 0 : z) + above;
      };
      SightTrack track;
      const Vec2 a = anywhere(), b = anywhere();
      track.points = {{a, 0}, {b, 30 * std::hypot(b.x - a.x, b.y - a.y)}};
      track.curvature = i % 4 == 0 ? 0 : i % 4 == 1 ? 1e-7 : i % 4 == 2 ? 1e-5 : -1e-6;
      const double from = heightAt(a), to = heightAt(b);
      if (!checkSightHeights(track, from, to)) continue;
      const SightLine line(track, from, to);
      SightOptions options{.wantsClearance = false, .wantsObstruction = i % 3 == 0};
      const SightAnswer expected = scan->answer(line, options), found = embree->answer(line, options);
      EXPECT_EQ(found.verdict, expected.verdict);
      if (options.wantsObstruction) {
        ASSERT_EQ(found.obstruction.has_value(), expected.obstruction.has_value());
      }
      visible += found.verdict == SightVerdict::visible;
      blocked += found.verdict == SightVerdict::blocked;
      EXPECT_FALSE(found.clearance);
    }
  }
  EXPECT_GT(visible, 300u);
  EXPECT_GT(blocked, 300u);
}

TEST(SightEmbree, ComputesClearancesWhenRequested) {
  const auto model = build(rasterFamilies()[3].make(40, 40, 2));
  ASSERT_TRUE(model);
  SightTrack track;
  track.points = {{{2, 3}, 0}, {{35, 30}, 1000}};
  const SightLine line(track, 1e5, 1e5);
  const SightAnswer a = makeSightEmbree(*model)->answer(line, {}),
                    b = makeSightDescent(*model)->answer(line, {});
  ASSERT_TRUE(a.clearance && b.clearance);
  EXPECT_EQ(*a.clearance, *b.clearance);
}

}  // namespace
}  // namespace arete::test
