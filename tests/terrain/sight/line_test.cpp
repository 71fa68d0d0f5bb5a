// SPDX-License-Identifier: GPL-3.0-or-later
//
// The polynomials against the oracle's chord, and the laws that engines rely on.
#include "terrain/sight/line.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "datasets/random.h"
#include "terrain/sight_oracle.h"

namespace arete::test {
namespace {

using LongReal = long double;

struct Made {
  double curvature, length, h0, h1, unit;
  SightLine line() const {
    SightTrack track;
    track.points = {{{0, 0}, 0}, {{1, 2}, length}};
    track.curvature = curvature;
    return SightLine(track, h0 / unit, h1 / unit, unit);
  }
  OracleLine truth() const {
    return OracleLine(curvature, length, LongReal(h0 / unit) * unit, LongReal(h1 / unit) * unit);
  }
  std::string name() const {
    return "k " + std::to_string(curvature * 1e9) + "e-9, length " + std::to_string(length) + ", heights " +
           std::to_string(h0) + " " + std::to_string(h1) + ", unit " + std::to_string(unit);
  }
};

Made make(Random& random, double earth = 6371000) {
  constexpr std::array kRefraction = {0.0, 1.0 / 7, 1.0, 1.5};
  const double radius = earth * random.between(0.995, 1.005);
  const auto height = [&] {
    switch (random.below(4)) {
      case 0:
        return random.between(-400, 20000);
      case 1:
        return random.between(0, 3);
      default:
        return random.between(-400, 9000);
    }
  };
  const double k = (1 - kRefraction[random.below(4)]) / radius;
  return {k, std::pow(10.0, random.between(0, 6)), height(), height(), random.below(3) ? 1.0 : 0.3048};
}

TEST(SightLine, IsWithinATenthOfAMicrometreOfTheChord) {
  constexpr std::uint64_t kSeed = 1;
  SCOPED_TRACE(kSeed);
  Random random(kSeed);
  double worst = 0;
  for (int i = 0; i < 2000; ++i) {
    const Made made = make(random);
    const SightLine line = made.line();
    const OracleLine truth = made.truth();
    for (int j = 0; j <= 60; ++j) {
      const double s = j == 60 ? made.length : made.length * random.unit();
      const double off = std::fabs(double(line.height(s) * LongReal(made.unit) - truth.height(s)));
      ASSERT_LE(off, 1e-7) << made.name() << " at " << s;
      worst = std::max(worst, off);
    }
    ASSERT_NEAR(line.height(0) * made.unit, made.h0, 1e-7) << made.name();
  }
  RecordProperty("worst", std::to_string(worst));
  std::printf("worst: %.3g m\n", worst);
}

TEST(SightLine, IsAsExactOnSmallerWorlds) {
  constexpr std::uint64_t kSeed = 2;
  SCOPED_TRACE(kSeed);
  Random random(kSeed);
  for (const double radius : {3389500.0, 1737400.0, 476200.0, 250000.0})  // Mars, Moon, Ceres, an asteroid
    for (int i = 0; i < 300; ++i) {
      Made made = make(random, radius);
      made.length = std::min(made.length, radius);
      made.h0 *= radius / 6371000;
      made.h1 *= radius / 6371000;
      const SightLine line = made.line();
      const OracleLine truth = made.truth();
      for (int j = 0; j <= 60; ++j) {
        const double s = made.length * random.unit();
        ASSERT_NEAR(double(line.height(s) * LongReal(made.unit) - truth.height(s)), 0, 1e-7)
            << "radius " << radius << ", " << made.name() << " at " << s;
      }
    }
}

TEST(SightLine, HasTheSlopeOfTheChordAndCurvesNoMoreThanItsSag) {
  constexpr std::uint64_t kSeed = 3;
  SCOPED_TRACE(kSeed);
  Random random(kSeed);
  for (int i = 0; i < 2000; ++i) {
    const Made made = make(random);
    const SightLine line = made.line();
    const OracleLine truth = made.truth();
    EXPECT_GE(line.sag(), 0);
    if (made.curvature == 0) {
      EXPECT_EQ(line.sag(), 0);
    }
    for (int j = 0; j < 30; ++j) {
      const double s = made.length * random.unit();
      const LongReal slope = truth.at(s).slope;
      ASSERT_NEAR(line.slope(s) * made.unit, double(slope), 1e-9 * (1 + std::fabs(double(slope))))
          << made.name();
      // The slope's slope, by a difference that rounding leaves alone.
      const LongReal d = made.length / 1000;
      if (s < d || s > made.length - d) continue;
      const LongReal bend = (truth.at(s + d).slope - truth.at(s - d).slope) / (2 * d);
      ASSERT_LE(double(bend), line.sag() * made.unit * (1 + 1e-6) + 1e-15) << made.name();
    }
  }
}

/// The formula of docs/topics/visibility.md.
LongReal documented(LongReal k, LongReal length, LongReal h0, LongReal h1, LongReal s) {
  const auto sn = [k](LongReal x) { return std::sin(k * x) / k; };
  const LongReal rest = length - s;
  return (h0 * (sn(length) - sn(s)) + h1 * (sn(length) - sn(rest)) + k * h0 * h1 * sn(length) -
          4 * k * sn(length / 2) * sn(s / 2) * sn(rest / 2)) /
         ((1 + k * h0) * sn(s) + (1 + k * h1) * sn(rest));
}

TEST(SightLine, IsTheDocumentedFormulaHoweverHighItsEndsAre) {
  constexpr std::uint64_t kSeed = 5;
  SCOPED_TRACE(kSeed);
  Random random(kSeed);
  for (int i = 0; i < 4000; ++i) {
    Made made = make(random);
    made.curvature = (random.below(2) == 0 ? 1 : 6.0 / 7) / 6371000;
    made.h0 = std::pow(10.0, random.between(4, 7.602));  // 4e7: beyond satellites that stand still
    if (random.below(4) == 0) made.h1 = std::pow(10.0, random.between(4, 7.602));
    if (random.below(2) == 0) std::swap(made.h0, made.h1);
    const SightLine line = made.line();
    const LongReal h0 = LongReal(made.h0 / made.unit) * made.unit,
                   h1 = LongReal(made.h1 / made.unit) * made.unit;
    const auto within = [](double height) { return 1e-7 + 1e-14 * std::fabs(height); };
    ASSERT_NEAR(line.height(0) * made.unit, made.h0, within(made.h0)) << made.name();
    ASSERT_NEAR(line.height(made.length) * made.unit, made.h1, within(made.h1)) << made.name();
    for (int j = 0; j < 40; ++j) {
      // As often near the lower end, where the terrain is, as anywhere.
      double s = made.length * (j % 2 == 0 ? random.unit() : std::pow(10.0, random.between(-6, 0)));
      if (made.h1 < made.h0) s = made.length - s;
      s = std::clamp(s, 0.0, made.length);
      const double truth = double(documented(made.curvature, made.length, h0, h1, s));
      // A distance is rounded, and the line may be steep.
      const double rounded = 2.3e-16 * s * std::fabs(line.slope(s)) * made.unit;
      ASSERT_NEAR(line.height(s) * made.unit, truth, within(truth) + rounded) << made.name() << " at " << s;
    }
    // No bound is above the least clearance, and none of terrain far below the line says nothing.
    double s0 = made.length * random.unit(), s1 = made.length * random.unit();
    if (s0 > s1) std::swap(s0, s1);
    const double z0 = random.between(0, 9000), z1 = random.between(0, 9000);
    const double least = line.least(s0, z0, s1, z1).clearance, bound = line.leastBound(s0, z0, s1, z1);
    const double scale = std::max(std::fabs(line.height(s0)), std::fabs(line.height(s1)));
    ASSERT_LE(bound, least + 1e-6 + 1e-13 * scale) << made.name();
    for (int j = 0; j <= 200; ++j) {
      const double s = s0 + (s1 - s0) * j / 200;
      ASSERT_LE(least, line.height(s) - (z0 + (z1 - z0) * j / 200) + 1e-6 + 1e-13 * scale) << made.name();
    }
  }
}

TEST(SightLine, RefusesHeightsThatMakeNone) {
  SightTrack track;
  track.points = {{{0, 0}, 0}, {{1, 2}, 6000}};
  track.curvature = 1 / 7e6;
  EXPECT_TRUE(checkSightHeights(track, 4e7, 2));
  EXPECT_FALSE(checkSightHeights(track, 2, -4e6));
  track.curvature = -1 / 7e6;
  EXPECT_FALSE(checkSightHeights(track, 4e7, 2));
}

TEST(SightLine, IsTheSameFromEitherEnd) {
  constexpr std::uint64_t kSeed = 4;
  SCOPED_TRACE(kSeed);
  Random random(kSeed);
  for (int i = 0; i < 2000; ++i) {
    const Made made = make(random);
    Made back = made;
    std::swap(back.h0, back.h1);
    const SightLine there = made.line(), again = back.line();
    EXPECT_EQ(there.tolerance(), again.tolerance());
    for (int j = 0; j <= 30; ++j) {
      const double s = made.length * (j / 30.0);
      ASSERT_NEAR(there.height(s), again.height(std::max(0.0, made.length - s)), 2e-7 / made.unit)
          << made.name();
    }
  }
}

TEST(SightLine, HasItsLeastClearanceWhereADenseSearchHasIt) {
  constexpr std::uint64_t kSeed = 6;
  SCOPED_TRACE(kSeed);
  Random random(kSeed);
  int inside = 0;
  for (int i = 0; i < 2000; ++i) {
    const Made made = make(random);
    const SightLine line = made.line();
    const OracleLine truth = made.truth();
    double s0 = made.length * random.unit(), s1 = made.length * random.unit();
    if (s0 > s1) std::swap(s0, s1);
    if (random.below(3) == 0) s1 = std::min(made.length, s0 + random.between(0, 100));
    if (random.below(50) == 0) s1 = s0;
    // Planes that the line runs nearly parallel to somewhere.
    const double mid = random.between(s0, s1);
    double rise = line.slope(mid);
    if (random.below(3) == 0) rise += random.between(-1, 1) * 1e-3;
    const double z0 = line.height(s0) - rise * (mid - s0) + random.between(-10, 10);
    const double z1 = z0 + rise * (s1 - s0);
    const SightLine::Least found = line.least(s0, z0, s1, z1);
    const auto over = [&](LongReal s) {
      const LongReal f = s1 > s0 ? (s - s0) / (LongReal(s1) - s0) : 0;
      return truth.height(s) / made.unit - (z0 + f * (LongReal(z1) - z0));
    };
    LongReal least = std::min(over(s0), over(s1));
    LongReal low = s0,
             high = s1;  // a ternary search finds the least of a convex function; the ends that of others
    for (int j = 0; j < 80 && s1 > s0; ++j) {
      const LongReal a = low + (high - low) / 3, b = high - (high - low) / 3;
      const LongReal fa = over(a), fb = over(b);
      least = std::min({least, fa, fb});
      (fa < fb ? high : low) = fa < fb ? b : a;
    }
    for (int j = 0; j <= 100; ++j) least = std::min(least, over(s0 + (LongReal(s1) - s0) * j / 100));
    ASSERT_NEAR(found.clearance, double(least), 2e-7 / made.unit) << made.name() << " " << s0 << " " << s1;
    ASSERT_GE(found.distance, s0);
    ASSERT_LE(found.distance, s1);
    ASSERT_NEAR(double(over(found.distance)), double(least), 2e-7 / made.unit) << made.name();
    const double bound = line.leastBound(s0, z0, s1, z1), d = s1 - s0;
    ASSERT_LE(bound, double(least) + 2e-7 / made.unit) << made.name();
    ASSERT_GE(bound, double(least) - line.sag() * d * d / 8 - 2e-7 / made.unit) << made.name();
    if (found.distance > s0 && found.distance < s1) ++inside;
  }
  EXPECT_GT(inside, 200);
}

TEST(SightLine, RanksWhatIsSeenByTheTangentOfItsElevation) {
  constexpr std::uint64_t kSeed = 7;
  SCOPED_TRACE(kSeed);
  Random random(kSeed);
  for (int i = 0; i < 20000; ++i) {
    const Made made = make(random);
    if (made.length < 10) continue;
    const double tangent = sightTangent(made.curvature, made.h0, made.length, made.h1);
    const LongReal truth = OracleLine(made.curvature, made.length, made.h0, made.h1).tangentAtFirst();
    ASSERT_NEAR(tangent, double(truth), 1e-12 * (1 + std::fabs(tangent))) << made.name();
    ASSERT_GT(sightTangent(made.curvature, made.h0, made.length, made.h1 + 0.01), tangent) << made.name();
    ASSERT_NEAR(sightHeight(made.curvature, made.h0, made.length, tangent), made.h1,
                1e-9 * (1 + std::fabs(made.h1) + std::fabs(made.h0) + made.length))
        << made.name();
  }
}

TEST(SightLine, OfTwoEndsInOnePlaceIsAsHighAsTheLower) {
  SightTrack track;
  track.points = {{{3, 4}, 0}, {{3, 4}, 0}};
  track.curvature = 1e-7;
  const SightLine line(track, 25, 17, 0.3048);
  EXPECT_EQ(line.height(0), 17);
  EXPECT_EQ(line.length(), 0);
  EXPECT_EQ(line.least(0, 10, 0, 10).clearance, 7);
  EXPECT_EQ(line.planAt(0), (Vec2{3, 4}));
}

TEST(SightLine, FindsThePlaceInPlanAlongAChainOfPieces) {
  SightTrack track;
  track.points = {{{0, 0}, 0}, {{4, 0}, 40}, {{4, 0}, 50}, {{4, 6}, 110}};
  const SightLine line(track, 1, 2);
  const auto expectAt = [&](double s, Vec2 place) {
    EXPECT_NEAR(line.planAt(s).x, place.x, 1e-12) << s;
    EXPECT_NEAR(line.planAt(s).y, place.y, 1e-12) << s;
  };
  expectAt(0, {0, 0});
  expectAt(10, {1, 0});
  expectAt(40, {4, 0});
  expectAt(45, {4, 0});
  expectAt(80, {4, 3});
  expectAt(110, {4, 6});
}

}  // namespace
}  // namespace arete::test
