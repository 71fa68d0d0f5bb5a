// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/base/similarity.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace arete {
namespace {

TEST(Similarity, HeadsClockwisePitchesItsFrontUpAndRollsItsRightSideDown) {
  const Vec3 ahead{0, 1, 0}, right{1, 0, 0}, up{0, 0, 1};
  EXPECT_EQ(Similarity({.heading = 90}, 1, {})(ahead), (Vec3{1, 0, 0}));
  EXPECT_EQ(Similarity({.pitch = 90}, 1, {})(ahead), (Vec3{0, 0, 1}));
  EXPECT_EQ(Similarity({.roll = 90}, 1, {})(right), (Vec3{0, 0, -1}));
  EXPECT_EQ(Similarity({.roll = 90}, 1, {})(up), (Vec3{1, 0, 0}));
  // A model whose up is y stands up by a pitch of 90 degrees.
  EXPECT_EQ(Similarity({.pitch = 90}, 2, {10, 20, 30})({1, 2, 3}), (Vec3{12, 14, 34}));
  // Pitched first, then headed: its front is up and to the east.
  const Vec3 front = Similarity({.heading = 90, .pitch = 45}, 1, {})(ahead);
  EXPECT_NEAR(front.x, std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(front.y, 0, 1e-15);
  EXPECT_NEAR(front.z, std::sqrt(0.5), 1e-15);
}

TEST(Similarity, RightAnglesOfAnySizeAndSignAreExact) {
  for (const double turns : {-720.0, -450.0, -90.0, 0.0, 180.0, 270.0, 990.0}) {
    const Vec3 p = Similarity(Turn{turns, turns, turns}, 1, {})({1, 2, 3});
    for (const double c : {p.x, p.y, p.z}) EXPECT_EQ(c, std::round(c)) << turns;
  }
}

TEST(Similarity, ItsInverseAndProductsAgreeWithWhatTheyStandFor) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> angle(-400, 400), size(0.01, 100), place(-1000, 1000);
  for (int i = 0; i < 200; ++i) {
    const auto made = [&] {
      return Similarity(Turn{angle(random), angle(random), angle(random)}, size(random),
                        {place(random), place(random), place(random)});
    };
    const Similarity a = made(), b = made();
    const Vec3 p{place(random), place(random), place(random)}, both = (a * b)(p), there = a(b(p));
    EXPECT_LT(norm(both - there), 1e-9 * (1 + norm(there))) << "seed 7, case " << i;
    EXPECT_LT(norm(a.inverse()(a(p)) - p), 1e-9 * (1 + norm(p) + norm(a.shift()) / a.scale()));
    EXPECT_NEAR(dot(cross(a.axes()[0], a.axes()[1]), a.axes()[2]), 1, 1e-12);
  }
}

}  // namespace
}  // namespace arete
