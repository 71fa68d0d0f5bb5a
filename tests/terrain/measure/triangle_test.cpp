// SPDX-License-Identifier: GPL-3.0-or-later
//
// Contacts of random triangles and points against long double; pseudo-angles against their definition.
#include "terrain/measure/triangle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace arete::measuring {
namespace {

constexpr double kTolerance = 1e-6;

/// Distance of a point to the triangle's rim, positive inside; and the plane's height there.
struct Oracle {
  long double inside, height;
};

Oracle oracleAt(const std::array<Vec2, 3>& p, const std::array<double, 3>& z, double x, double y) {
  using Real = long double;
  const auto area = [](Vec2 a, Vec2 b, Real cx, Real cy) {
    return (Real(b.x) - a.x) * (cy - a.y) - (Real(b.y) - a.y) * (cx - a.x);
  };
  const Real whole = area(p[0], p[1], p[2].x, p[2].y);
  Real height = 0, toRim = 1e30L;
  bool isInside = true;
  for (int i = 0; i < 3; ++i) {
    const Vec2 a = p[(i + 1) % 3], b = p[(i + 2) % 3];
    const Real w = area(a, b, x, y) / whole, dx = Real(b.x) - a.x, dy = Real(b.y) - a.y;
    height += w * z[i];
    isInside = isInside && w >= 0;
    const Real t = std::clamp(((x - a.x) * dx + (y - a.y) * dy) / (dx * dx + dy * dy), Real(0), Real(1));
    toRim = std::min(toRim, std::hypot(a.x + t * dx - x, a.y + t * dy - y));
  }
  return {isInside ? toRim : -toRim, height};
}

TEST(PlanTriangle, MeetsPointsAsItsDistanceSays) {
  for (const unsigned seed : {1u, 2u, 3u, 4u}) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> anywhere(-10, 10);
    int covered = 0, decided = 0;
    for (int k = 0; k < 20000; ++k) {
      std::array<Vec2, 3> corner;
      for (Vec2& p : corner) p = {anywhere(random), anywhere(random)};
      const std::array<double, 3> z = {anywhere(random), anywhere(random), anywhere(random)};
      double x = anywhere(random), y = anywhere(random);
      if (k % 3 == 0) {  // near a side
        const double t = anywhere(random) / 10;
        x = corner[0].x + t * (corner[1].x - corner[0].x) + 1e-7 * anywhere(random);
        y = corner[0].y + t * (corner[1].y - corner[0].y) + 1e-7 * anywhere(random);
      }
      PlanTriangle triangle;
      if (!triangle.set(corner, z, 1e-3)) continue;
      const Oracle expected = oracleAt(corner, z, x, y);
      const Contact contact = triangle.contact(x, y, kTolerance);
      if (std::abs(std::abs(double(expected.inside)) - kTolerance) < 1e-12) continue;  // rounding decides
      ++decided;
      ASSERT_EQ(contact.covers, expected.inside > -kTolerance) << k;
      ASSERT_EQ(contact.strict, expected.inside > kTolerance) << k;
      covered += contact.covers;
      if (expected.inside >= 0) {
        ASSERT_NEAR(contact.z, double(expected.height), 1e-6) << k;
      }
      if (contact.strict) {
        ASSERT_EQ(contact.turn, kFullTurn) << k;
      }
    }
    EXPECT_GT(covered, 2000);
    EXPECT_GT(decided, 15000);
  }
}

TEST(PlanTriangle, TurnsClockwiseCornersAndRefusesThinOnes) {
  PlanTriangle triangle;
  EXPECT_TRUE(triangle.set({Vec2{0, 0}, {0, 4}, {4, 0}}, {1, 2, 3}, 1e-6));
  EXPECT_EQ(triangle.area2, 16);
  EXPECT_EQ(triangle.corner[1], (Vec2{4, 0}));
  EXPECT_EQ(triangle.z[1], 3);
  EXPECT_EQ(triangle.contact(4, 0, 1e-6).z, 3);
  EXPECT_EQ(triangle.contact(1, 1, 1e-6).z, 1.75);
  EXPECT_FALSE(triangle.set({Vec2{0, 0}, {10, 1e-7}, {20, 0}}, {0, 0, 0}, 1e-6));
  EXPECT_TRUE(triangle.set({Vec2{0, 0}, {10, 1e-5}, {20, 0}}, {0, 0, 0}, 1e-6));
}

TEST(PlanTriangle, KeepsTheHeightOfItsNearestPointOutside) {
  // The plane of a needle rises 1e6 per pixel across; a point beside it gets the height of its side.
  PlanTriangle needle;
  ASSERT_TRUE(needle.set({Vec2{0, 0}, {10, 0}, {5, 1e-4}}, {0, 10, 100}, 1e-6));
  const Contact below = needle.contact(4, -5e-7, kTolerance);
  EXPECT_TRUE(below.covers);
  EXPECT_FALSE(below.strict);
  EXPECT_NEAR(below.z, 4, 1e-9);
  EXPECT_FALSE(needle.contact(4, -2e-6, kTolerance).covers);
  EXPECT_FALSE(needle.contact(-1e-5, 0, kTolerance).covers) << "no mitre at the sharp corner";
}

TEST(PlanTriangle, ContactsOfAFanFillOneTurn) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> jitter(-0.3, 0.3);
    for (int n = 4; n < 12; ++n) {
      std::vector<Vec2> rim;
      for (int i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * (i + jitter(random)) / n;
        rim.push_back({3 * std::cos(angle), 3 * std::sin(angle)});
      }
      float turn = 0;
      for (int i = 0; i < n; ++i) {
        PlanTriangle triangle;
        ASSERT_TRUE(triangle.set({Vec2{0, 0}, rim[i], rim[(i + 1) % n]}, {0, 0, 0}, kTolerance));
        turn += triangle.contact(0, 0, kTolerance).turn;
      }
      EXPECT_NEAR(turn, kFullTurn, 1e-5) << "seed " << seed << ", " << n << " triangles";
    }
  }
}

TEST(TurnBetween, IsAdditiveAndHalfATurnBetweenOppositeDirections) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> anywhere(-5, 5);
  for (int k = 0; k < 1000; ++k) {
    const Vec2 o{anywhere(random), anywhere(random)}, d{anywhere(random), anywhere(random)},
        e{anywhere(random), anywhere(random)};
    const Vec2 from{o.x + d.x, o.y + d.y}, opposite{o.x - d.x, o.y - d.y}, other{o.x + e.x, o.y + e.y};
    EXPECT_NEAR(turnBetween(o, from, opposite), kHalfTurn, 1e-5) << k;
    EXPECT_NEAR(turnBetween(o, from, other) + turnBetween(o, other, from), kFullTurn, 1e-5) << k;
  }
}

}  // namespace
}  // namespace arete::measuring
