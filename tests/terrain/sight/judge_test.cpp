// SPDX-License-Identifier: GPL-3.0-or-later
//
// Random polylines below straight lines: on a flat Earth everything that a judge computes is at a vertex or
// at a crossing of two straight lines, which the test computes itself.
#include "terrain/sight/judge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "datasets/random.h"

namespace arete::test {
namespace {

struct Polyline {
  std::vector<double> s, z;
};

Polyline randomTerrain(Random& random, double length) {
  Polyline terrain;
  const std::uint32_t count = 2 + random.below(12);
  for (std::uint32_t i = 0; i < count; ++i) {
    terrain.s.push_back(length * i / (count - 1));
    terrain.z.push_back(random.between(-20, 4));
  }
  return terrain;
}

SightLine flatLine(double length, double from, double to) {
  SightTrack track;
  track.points = {{{0, 0}, 0}, {{length / 10, 0}, length}};
  return SightLine(track, from, to);
}

void reportAll(SightJudge& judge, const Polyline& terrain) {
  for (std::size_t i = 1; i < terrain.s.size() && !judge.isDone(); ++i)
    judge.terrain(terrain.s[i - 1], terrain.z[i - 1], terrain.s[i], terrain.z[i]);
}

TEST(SightJudge, FindsTheLeastClearanceAndTheFirstCrossing) {
  constexpr std::uint64_t kSeed = 11;
  Random random(kSeed);
  int blocked = 0, visible = 0;
  for (int i = 0; i < 5000; ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", line " << i);
    const double length = random.between(10, 5000);
    const double h0 = random.between(0, 10), h1 = random.between(0, 10);
    const Polyline terrain = randomTerrain(random, length);
    const auto clearanceAt = [&](std::size_t v) {
      return h0 + (h1 - h0) * terrain.s[v] / length - terrain.z[v];
    };
    double least = HUGE_VAL, first = -1;
    for (std::size_t v = 0; v < terrain.s.size(); ++v) {
      const double c = clearanceAt(v);
      least = std::min(least, c);
      if (c >= 0 || first >= 0) continue;
      if (v == 0) {
        first = 0;
      } else {
        const double before = clearanceAt(v - 1);
        first = terrain.s[v - 1] + (terrain.s[v] - terrain.s[v - 1]) * before / (before - c);
      }
    }
    const SightLine line = flatLine(length, h0, h1);
    SightJudge judge(line, {});
    reportAll(judge, terrain);
    const SightAnswer answer = judge.answer(0);
    ASSERT_TRUE(answer.clearance);
    EXPECT_NEAR(*answer.clearance, least, 1e-9);
    EXPECT_EQ(answer.verdict, least < 0 ? SightVerdict::blocked : SightVerdict::visible);
    ASSERT_EQ(answer.obstruction.has_value(), least < 0);
    if (answer.obstruction) {
      EXPECT_NEAR(answer.obstruction->distance, first, 1e-6 * length);
    }
    ++(least < 0 ? blocked : visible);
    // Without the clearance the judge may stop early, with the same verdict and obstruction.
    SightJudge quick(line, {.wantsClearance = false});
    reportAll(quick, terrain);
    const SightAnswer early = quick.answer(0);
    EXPECT_EQ(early.verdict, answer.verdict);
    EXPECT_FALSE(early.clearance);
    ASSERT_EQ(early.obstruction.has_value(), answer.obstruction.has_value());
    if (early.obstruction) {
      EXPECT_EQ(early.obstruction->distance, answer.obstruction->distance);
    }
  }
  EXPECT_GT(blocked, 500);
  EXPECT_GT(visible, 500);
}

TEST(SightJudge, TerrainThatDoesNotMatterChangesNothing) {
  constexpr std::uint64_t kSeed = 12;
  Random random(kSeed);
  int skipped = 0;
  for (int i = 0; i < 3000; ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", line " << i);
    const double length = 1000;
    const Polyline terrain = randomTerrain(random, length);
    const SightLine line = flatLine(length, random.between(0, 10), random.between(0, 10));
    const SightOptions options{.wantsClearance = random.below(2) == 0};
    SightJudge whole(line, options), sparing(line, options);
    for (std::size_t v = 1; v < terrain.s.size(); ++v) {
      const double s0 = terrain.s[v - 1], z0 = terrain.z[v - 1], s1 = terrain.s[v], z1 = terrain.z[v];
      whole.terrain(s0, z0, s1, z1);
      const double above = random.between(0, 3);
      if (!sparing.matters(s0, z0 + above, s1, z1 + above, false)) {
        ++skipped;
        continue;
      }
      sparing.terrain(s0, z0, s1, z1);
    }
    const SightAnswer a = whole.answer(0), b = sparing.answer(0);
    EXPECT_EQ(a.verdict, b.verdict);
    EXPECT_EQ(a.clearance, b.clearance);
    ASSERT_EQ(a.obstruction.has_value(), b.obstruction.has_value());
    if (a.obstruction) {
      EXPECT_EQ(a.obstruction->distance, b.obstruction->distance);
    }
  }
  EXPECT_GT(skipped, 1000);
}

TEST(SightJudge, AGapCountsAsTheOptionSays) {
  const SightLine line = flatLine(100, 5, 5);
  for (const NodataSight nodata : {NodataSight::unknown, NodataSight::clear, NodataSight::blocked}) {
    SightJudge judge(line, {.nodata = nodata});
    judge.terrain(0, 0, 30, 0);
    judge.gap(30, 50);
    judge.terrain(50, 0, 100, 0);
    const SightAnswer answer = judge.answer(7);
    EXPECT_EQ(answer.verdict, nodata == NodataSight::unknown ? SightVerdict::unknown
                              : nodata == NodataSight::clear ? SightVerdict::visible
                                                             : SightVerdict::blocked);
    EXPECT_EQ(answer.gapMetres, nodata == NodataSight::clear ? 0 : 20);
    EXPECT_EQ(answer.visited, 7u);
    ASSERT_EQ(answer.obstruction.has_value(), nodata == NodataSight::blocked);
    if (answer.obstruction) {
      EXPECT_EQ(answer.obstruction->distance, 30);
      EXPECT_TRUE(std::isnan(answer.obstruction->terrainHeight));
    }
  }
}

TEST(SightJudge, TerrainWithinBoundsLeavesACloseLineUndecided) {
  const SightLine line = flatLine(100, 5, 5);
  const auto answerFor = [&](double z) {
    SightJudge judge(line, {.maxError = 1});
    judge.terrain(0, z, 100, z, 1, 1);
    return judge.answer(0);
  };
  EXPECT_EQ(answerFor(3).verdict, SightVerdict::visible);
  EXPECT_EQ(answerFor(4.5).verdict, SightVerdict::undecided);
  EXPECT_EQ(answerFor(5.5).verdict, SightVerdict::undecided);
  EXPECT_EQ(answerFor(7).verdict, SightVerdict::blocked);
  EXPECT_NEAR(*answerFor(3).clearance, 2, 1e-12);
  EXPECT_NEAR(answerFor(3).clearanceWithin, 1, 1e-12);
  EXPECT_TRUE(answerFor(7).isObstructionLatest);
}

TEST(SightJudge, SaysWhetherTheTerrainOfAHintWasReported) {
  const SightLine line = flatLine(100, 5, 5);
  SightJudge kept(line, {}), missed(line, {});
  for (SightJudge* judge : {&kept, &missed}) judge->hint(40, 4);
  kept.terrain(0, 4, 100, 4);
  missed.terrain(0, 0, 100, 0);
  EXPECT_TRUE(kept.areHintsKept());
  EXPECT_FALSE(missed.areHintsKept());
}

}  // namespace
}  // namespace arete::test
