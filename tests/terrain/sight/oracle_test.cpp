// SPDX-License-Identifier: GPL-3.0-or-later
//
// The oracle against what is known without it: closed forms on a sphere, planes, rasters of four samples.
#include "terrain/sight_oracle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "datasets/random.h"

namespace arete::test {
namespace {

using Real = long double;
constexpr Real kEarth = 6371000;

SightTrack straight(Vec2 from, Vec2 to, double metres, double curvature = 0) {
  SightTrack track;
  track.points = {{from, 0}, {to, metres}};
  track.curvature = curvature;
  return track;
}

std::vector<double> samples(std::uint32_t columns, std::uint32_t rows, double base, double dx, double dy) {
  std::vector<double> heights;
  for (std::uint32_t y = 0; y < rows; ++y)
    for (std::uint32_t x = 0; x < columns; ++x) heights.push_back(base + dx * x + dy * y);
  return heights;
}

TEST(SightOracleLine, DipsUnderTheSphereByTheBulgeInTheMiddle) {
  for (const Real k : {1 / kEarth, 6 / (7 * kEarth), Real(1e-3), Real(-1e-7)})
    for (const Real length : {1.0L, 300.0L, 1000.0L}) {
      const OracleLine line(k, length, 0, 0);
      const Real half = std::sin(k * length / 4);
      EXPECT_NEAR(double(line.height(length / 2) + 2 / k * half * half), 0, 1e-11) << double(length);
      EXPECT_NEAR(double(line.at(length / 2).slope), 0, 1e-15);
    }
}

TEST(SightOracleLine, TouchesTheSphereAtTheHorizon) {
  for (const Real h : {1.7L, 100.0L, 9000.0L}) {
    // The tangent from a height h meets the sphere at the angle acos(R / (R + h)), sqrt(2 R h + h^2) away.
    const Real tangent = std::sqrt(2 * kEarth * h + h * h), angle = std::atan2(tangent, kEarth);
    const OracleLine line(1 / kEarth, kEarth * angle, h, 0);
    EXPECT_NEAR(double(line.at(kEarth * angle).slope), 0, 1e-15);
    EXPECT_NEAR(double(line.height(kEarth * angle)), 0, 1e-11);
    EXPECT_GT(line.height(0.99L * kEarth * angle), 0);
    EXPECT_NEAR(double(line.tangentAtFirst()), -double(tangent / kEarth), 1e-14);
    // A level sight line of the second end's: beyond the horizon it is under the sphere.
    const OracleLine beyond(1 / kEarth, 1.1L * kEarth * angle, h, 0);
    EXPECT_LT(beyond.height(1.05L * kEarth * angle), 0);
  }
}

TEST(SightOracleLine, IsStraightWhereRefractionFollowsTheEarth) {
  const OracleLine line(0, 1000, 10, 30);
  EXPECT_EQ(line.height(0), 10);
  EXPECT_NEAR(double(line.height(250)), 15, 1e-15);
  EXPECT_NEAR(double(line.height(1000)), 30, 1e-15);
}

TEST(SightOracleLine, IsTheSameFromEitherEndAndAgreesWithTheFormulaOfTheDocumentation) {
  constexpr std::uint64_t kSeed = 5;
  SCOPED_TRACE(kSeed);
  Random random(kSeed);
  for (int i = 0; i < 20000; ++i) {
    const Real k = (1 - random.between(0, 1.5)) / kEarth;
    const Real length = std::pow(10.0, random.between(0, 6));
    const Real h0 = random.between(-400, 9000), h1 = random.between(-400, 9000);
    if (std::fabs(k) < 1e-12L) continue;
    const OracleLine there(k, length, h0, h1), back(k, length, h1, h0);
    const Real s = length * random.unit();
    EXPECT_NEAR(double(there.height(s) - back.height(length - s)), 0, 1e-8);
    const auto sn = [&](Real x) { return std::sin(k * x) / k; };
    const Real up = h0 * (sn(length) - sn(s)) + h1 * (sn(length) - sn(length - s)) +
                    k * h0 * h1 * sn(length) - 4 * k * sn(length / 2) * sn(s / 2) * sn((length - s) / 2);
    const Real down = (1 + k * h0) * sn(s) + (1 + k * h1) * sn(length - s);
    ASSERT_NEAR(double(there.height(s) - up / down), 0, 1e-8) << i;
    const Real d = length * 1e-4L;
    if (s > d && s < length - d) {
      const Real difference = (there.height(s + d) - there.height(s - d)) / (2 * d);
      ASSERT_NEAR(double(there.at(s).slope - difference), 0, 1e-5 * (1 + std::fabs(double(difference)))) << i;
      ASSERT_NEAR(double(there.whereSlopeIs(there.at(s).slope) - s), 0, 1e-3) << i;
    }
  }
}

TEST(SightOracle, KnowsThePlaneOnWhichItStands) {
  const SightOracle oracle(9, 7, samples(9, 7, 100, 3, -2));
  for (const Vec2 p : {Vec2{0, 0}, {8, 6}, {3.25, 4.75}, {0, 3.3}, {2, 2}, {7.999, 5.001}})
    EXPECT_NEAR(double(*oracle.heightAt(p)), 100 + 3 * p.x - 2 * p.y, 1e-12);
  EXPECT_FALSE(oracle.heightAt({-0.001, 2}));
  EXPECT_FALSE(oracle.heightAt({4, 6.001}));
  // Above the plane by 5 and 7, so by 5 at least; gaps at either side.
  const OracleAnswer up = oracle.ask(straight({1, 1}, {5, 6}, 100), 101 + 5, 103 + 7);
  EXPECT_NEAR(double(*up.clearance), 5, 1e-12);
  EXPECT_EQ(up.gapMetres, 0);
  EXPECT_FALSE(up.deep);
  const OracleAnswer out = oracle.ask(straight({-2, 3}, {10, 3}, 120), 200, 200);
  EXPECT_NEAR(double(out.gapMetres), 40, 1e-8);
  EXPECT_NEAR(double(out.longestGapInPlan), 2, 1e-8);
  EXPECT_EQ(*out.firstGap, 0);
  EXPECT_NEAR(double(*out.clearance), 200 - (100 + 24 - 6), 1e-11);
}

TEST(SightOracle, FindsTheBulgeOnASphereOfNoTerrain) {
  const double k = 1e-5, length = 2000;
  const SightOracle oracle(21, 3, samples(21, 3, 0, 0, 0));
  const OracleAnswer answer = oracle.ask(straight({0, 1.25}, {20, 1.25}, length, k), 3, 3);
  const Real R = 1 / Real(k), r = R + 3;
  EXPECT_NEAR(double(*answer.clearance), double(r * std::cos(length * k / 2) - R), 1e-11);
  EXPECT_NEAR(double(answer.at), length / 2, 1e-6);
  // Where it goes under: r cos(angle) / cos(a) = R, a from the middle.
  const Real a = std::acos(r * std::cos(Real(length) * k / 2) / R);
  ASSERT_TRUE(answer.ceased);
  EXPECT_NEAR(double(*answer.ceased), double(length / 2 - a * R), 1e-2);
  EXPECT_NEAR(double(*answer.deep), double(length / 2 - a * R), 1e-2);
}

TEST(SightOracle, SplitsACellAsTheDocumentationSays) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const auto at = [&](std::vector<double> heights, Vec2 p) {
    return SightOracle(2, 2, std::move(heights)).heightAt(p);
  };
  // Upper left and lower right are low: the diagonal is a valley.
  EXPECT_NEAR(double(*at({0, 8, 8, 0}, {0.5, 0.5})), 0, 1e-12);
  EXPECT_NEAR(double(*at({0, 8, 8, 0}, {0.75, 0.25})), 4, 1e-12);
  EXPECT_NEAR(double(*at({none, 8, 8, 0}, {0.75, 0.75})), 4, 1e-12);
  EXPECT_FALSE(at({none, 8, 8, 0}, {0.25, 0.25}));
  EXPECT_NEAR(double(*at({0, none, 8, 0}, {0.25, 0.5})), 2, 1e-12);
  EXPECT_FALSE(at({0, none, 8, 0}, {0.75, 0.25}));
  EXPECT_FALSE(at({0, none, none, 0}, {0.5, 0.5}));
}

}  // namespace
}  // namespace arete::test
