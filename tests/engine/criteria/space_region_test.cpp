// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/criteria/space_region.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace arete {
namespace {

TEST(SpaceRegion, MeetsATriangleWhereASampleOfItIsInsideOrWithinTheWidening) {
  std::mt19937_64 random(4);
  const auto number = [&] { return double(random() % 2001) / 1000 - 1; };
  const auto point = [&] { return Vec3{number(), number(), number()}; };
  int met = 0, apart = 0;
  for (int i = 0; i < 2000; ++i) {
    const bool isBox = i % 2 == 0;
    const Vec3 low = point(), high = low + Vec3{0.3, 0.2, 0.4};
    const double radius = 0.25;
    const BoxRegion box(low, high);
    const BallRegion ball(low, radius);
    const SpaceRegion& region = isBox ? static_cast<const SpaceRegion&>(box) : ball;
    const Vec3 a = point(), b = point(), c = point();
    const double widening = i % 3 == 0 ? 0 : std::abs(number()) / 3;
    const bool meets = region.meetsTriangle({a, b, c}, widening);
    double nearest = 1e9;
    for (int u = 0; u <= 40; ++u)
      for (int v = 0; u + v <= 40; ++v) {
        const Vec3 p = a + (u / 40.0) * (b - a) + (v / 40.0) * (c - a);
        const auto off = [](double x, double from, double to) { return std::max({from - x, 0.0, x - to}); };
        nearest = std::min(
            nearest, isBox ? norm({off(p.x, low.x, high.x), off(p.y, low.y, high.y), off(p.z, low.z, high.z)})
                           : norm(p - low) - radius);
      }
    EXPECT_TRUE(nearest > widening || meets) << i;
    EXPECT_TRUE(nearest <= widening + 0.06 || !meets) << i;
    (meets ? met : apart) += 1;
  }
  EXPECT_GT(met, 100);
  EXPECT_GT(apart, 200);
}

TEST(SpaceRegion, HoldsOnlyBallsThatItMeetsWholly) {
  const BoxRegion box({0, 0, 0}, {4, 4, 4});
  EXPECT_TRUE(box.holdsBall({2, 2, 2}, 1.9));
  EXPECT_FALSE(box.holdsBall({2, 2, 2}, 2));
  EXPECT_TRUE(box.meetsBall({5, 2, 2}, 1));
  EXPECT_FALSE(box.meetsBall({5, 5, 2}, 1));
  const BallRegion ball({0, 0, 0}, 2);
  EXPECT_TRUE(ball.holdsBall({1, 0, 0}, 0.9));
  EXPECT_FALSE(ball.holdsBall({1, 0, 0}, 1));
  EXPECT_TRUE(ball.meetsBall({3, 0, 0}, 1));
  EXPECT_FALSE(ball.meetsBall({3.1, 0, 0}, 1));
}

}  // namespace
}  // namespace arete
