// SPDX-License-Identifier: GPL-3.0-or-later
// Light is added up in linear intensities and clips nothing.
#include "viewer/color/light.h"

#include <gtest/gtest.h>

#include "viewer/color_oracle.h"

namespace arete {
namespace {

TEST(Light, ThatShowsAColourAsItIsKeepsItsBytes) {
  for (int v = 0; v < 256; ++v) {
    const Rgb c{std::uint8_t(v), std::uint8_t(255 - v), 17};
    EXPECT_EQ(lit(c, {1, 1, 1}), c);
    EXPECT_EQ(lit(c, {1 + 1e-12, 1 - 1e-12, 1}), c);
  }
}

TEST(Light, OfHalfIsHalfTheLinearIntensity) {
  for (int v = 0; v < 256; v += 5) {
    const Rgb half = lit({std::uint8_t(v), std::uint8_t(v), std::uint8_t(v)}, {0.5, 0.5, 0.5});
    EXPECT_NEAR(test::intensity(half.r), 0.5 * test::intensity(v), 0.004) << v;
  }
}

TEST(Light, HoweverStrongSaturatesNoColourThatIsNot) {
  for (int v = 0; v < 250; v += 3)
    for (const double k : {1.2, 1.5, 2.0, 2.5}) {
      const Rgb c = lit({std::uint8_t(v), 128, std::uint8_t(v)}, {k, k, k});
      EXPECT_LT(c.r, 255) << v << " under " << k;
      EXPECT_GE(c.r, v);
    }
}

TEST(Light, GrowsWithoutASteep) {
  for (int v = 10; v < 255; v += 20) {
    int before = 0;
    for (int i = 0; i <= 300; ++i) {
      const int now = lit({std::uint8_t(v), 0, 0}, {i / 100.0, 0, 0}).r;
      EXPECT_GE(now, before);
      if (i > 50) {
        EXPECT_LE(now, before + 2) << v << " at " << i;
      }
      before = now;
    }
  }
}

}  // namespace
}  // namespace arete
