// SPDX-License-Identifier: GPL-3.0-or-later
//
// The least clearance / F1 against a dense search along random profiles.
#include "terrain/sight/fresnel.h"

#include <gtest/gtest.h>

#include <cmath>

#include "datasets/random.h"

namespace arete::test {
namespace {

SightLine lineOver(double length, double from, double to, double curvature = 0) {
  SightTrack track;
  track.points = {{{0, 0}, 0}, {{length / 30, 0}, length}};
  track.curvature = curvature;
  return SightLine(track, from, to);
}

TEST(Fresnel, RadiiAreThoseOfTheRecommendation) {
  // ITU-R P.526: F1 = 17.3 sqrt(d1 d2 / (f d)), kilometres and GHz; a rounded constant.
  const double lambda = wavelengthMetres(2400);
  EXPECT_NEAR(lambda, 0.124914, 1e-6);
  EXPECT_NEAR(fresnelRadius(lambda, 4000, 10000), 17.3 * std::sqrt(4.0 * 6 / (2.4 * 10)), 0.02);
  EXPECT_EQ(fresnelRadius(lambda, 0, 10000), 0);
  EXPECT_EQ(fresnelRadius(lambda, 10000, 10000), 0);
  EXPECT_EQ(fresnelRadius(lambda, 3000, 10000), fresnelRadius(lambda, 7000, 10000));
}

TEST(Fresnel, TheLeastFractionIsThatOfADenseSearch) {
  constexpr std::uint64_t kSeed = 51;
  Random random(kSeed);
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", path " << i);
    const double length = random.between(500, 40000), lambda = wavelengthMetres(random.between(100, 6000));
    const SightLine line = lineOver(length, 60, random.between(40, 90), i % 2 == 0 ? 0 : 1.2e-7);
    Profile profile;
    profile.length = length;
    const int count = 3 + int(random.below(9));
    for (int v = 0; v < count; ++v)
      profile.vertices.push_back(
          {length * v / (count - 1), {0, 0}, random.between(-30, v == 0 || v == count - 1 ? 30 : 55), v > 0});
    // A gap, sometimes.
    if (i % 5 == 0) profile.vertices[1].isJoined = false;
    double least = HUGE_VAL;
    for (int v = 1; v < count; ++v) {
      const ProfileVertex &p = profile.vertices[v - 1], &q = profile.vertices[v];
      if (!q.isJoined) continue;
      for (int k = 0; k <= 2000; ++k) {
        const double t = k / 2000.0, s = p.distance + t * (q.distance - p.distance);
        const double radius = fresnelRadius(lambda, s, length);
        if (radius > 0)
          least = std::min(least, (line.height(s) - p.height - t * (q.height - p.height)) / radius);
      }
    }
    const auto found = leastFresnelClearance(line, profile, lambda);
    ASSERT_TRUE(found);
    EXPECT_LE(found->fraction, least + 1e-9);
    EXPECT_NEAR(found->fraction, least, 1e-3 * (1 + std::fabs(least)));
    EXPECT_NEAR((found->place.sightHeight - found->place.terrainHeight) /
                    fresnelRadius(lambda, found->place.distance, length),
                found->fraction, 1e-9 * (1 + std::fabs(found->fraction)));
  }
}

TEST(Fresnel, HasNoFractionWithoutTerrainOrFromBelowTheGround) {
  const SightLine line = lineOver(1000, 10, 10);
  EXPECT_FALSE(leastFresnelClearance(line, {.vertices = {}, .length = 1000}, 0.1));
  Profile buried{.vertices = {{0, {}, 12, false}, {1000, {}, 0, true}}, .length = 1000};
  EXPECT_FALSE(leastFresnelClearance(line, buried, 0.1));
  Profile ends{.vertices = {{0, {}, 0, false}, {1000, {}, 0, false}}, .length = 1000};
  EXPECT_FALSE(leastFresnelClearance(line, ends, 0.1));
}

}  // namespace
}  // namespace arete::test
