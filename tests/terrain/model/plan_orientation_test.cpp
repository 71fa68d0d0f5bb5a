// SPDX-License-Identifier: GPL-3.0-or-later
//
// Signs and weights against integers of 128 bits.
#include "terrain/model/plan_orientation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>

#include "datasets/random.h"

namespace arete {
namespace {

TEST(PlanOrientation, IsExactWherePointsAreAlmostOnALine) {
  __extension__ using Wide = __int128;
  Random random(3);
  const auto whole = [&](std::int64_t most) {
    return static_cast<std::int64_t>(random.unit() * double(most));
  };
  int zeros = 0;
  for (int i = 0; i < 20000; ++i) {
    // Multiples of 2^-20, all of 50 bits: a and b far apart, c one step or none off a point of their line.
    const std::int64_t ax = whole(1LL << 24), ay = whole(1LL << 24), dx = whole(1LL << 22) + 1,
                       dy = whole(1LL << 22);
    const std::int64_t at = whole(1 << 20);
    const std::int64_t bx = ax + (dx << 20), by = ay + (dy << 20);
    const std::int64_t cx = ax + dx * at + whole(3) - 1, cy = ay + dy * at + whole(3) - 1;
    const Wide turn = Wide(bx - ax) * (cy - ay) - Wide(by - ay) * (cx - ax);
    const int expected = (turn > 0) - (turn < 0);
    const auto point = [](std::int64_t x, std::int64_t y) {
      return Vec2{std::ldexp(double(x), -20), std::ldexp(double(y), -20)};
    };
    const Vec2 a = point(ax, ay), b = point(bx, by), c = point(cx, cy);
    ASSERT_EQ(planOrientation(a, b, c), expected) << i;
    ASSERT_EQ(planOrientation(b, c, a), expected) << i;
    ASSERT_EQ(planOrientation(b, a, c), -expected) << i;
    zeros += expected == 0;
  }
  EXPECT_GT(zeros, 100);
}

TEST(PlanOrientation, SurvivesTheSmallestAndTheLargestNumbers) {
  const double tiny = std::numeric_limits<double>::denorm_min(), large = 1e300;
  EXPECT_EQ(planOrientation({0, 0}, {tiny, 0}, {0, tiny}), 1);
  EXPECT_EQ(planOrientation({0, 0}, {tiny, tiny}, {2 * tiny, 2 * tiny}), 0);
  EXPECT_EQ(planOrientation({0, 0}, {large, 0}, {0, large}), 1);
  EXPECT_EQ(planOrientation({-large, -large}, {large, large}, {0, -large}), -1);
}

TEST(ExactPlanWeights, AreThoseOfWholeNumbersHoweverThinTheTriangle) {
  Random random(8);
  int thin = 0;
  for (int k = 0; k < 2000; ++k) {
    // Two long sides of whole numbers, a third one that makes twice the area small.
    const auto whole = [&](double most) { return std::floor(random.unit() * most); };
    const Vec2 a{whole(1000), whole(1000)}, b{a.x + 1 + whole(1e6), a.y + whole(1e6)};
    const Vec2 c{b.x + whole(3) - 1, b.y + whole(3) - 1}, p{whole(1e6), whole(1e6)};
    const auto area = [](Vec2 u, Vec2 v, Vec2 w) {
      return (v.x - u.x) * (w.y - u.y) - (v.y - u.y) * (w.x - u.x);
    };
    const double all = area(a, b, c);  // of whole numbers below 2^53: exact
    if (all == 0) continue;
    thin += std::abs(all) < 1e6 ? 1 : 0;
    const auto weights = exactPlanWeights(a, b, c, p);
    EXPECT_DOUBLE_EQ(weights[0], area(b, c, p) / all);
    EXPECT_DOUBLE_EQ(weights[1], area(c, a, p) / all);
    EXPECT_DOUBLE_EQ(weights[2], area(a, b, p) / all);
  }
  EXPECT_GT(thin, 500);
}

}  // namespace
}  // namespace arete
