// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/mt/outward_scale.h"

#include <gtest/gtest.h>

#include <random>

namespace arete {
namespace {

TEST(OutwardScale, NeverDecodesToLessThanWasEncoded) {
  std::mt19937_64 random(7);
  for (const double largest : {1e-3, 1.0, 8848.0, 1e9}) {
    const OutwardScale scale(largest);
    std::uniform_real_distribution<double> exponent(-12, 0);
    for (int i = 0; i < 20000; ++i) {
      const double x = largest * std::pow(10.0, exponent(random));
      EXPECT_GE(double(scale.decode(scale.encode(x))), x) << largest;
    }
    EXPECT_GE(double(scale.decode(scale.encode(largest))), largest);
  }
}

TEST(OutwardScale, GrowsAMagnitudeByAtMostOnePartIn2048) {
  const OutwardScale scale(1000.0);
  for (double x = 1e-5; x < 1000; x *= 1.0371)
    EXPECT_LE(scale.decode(scale.encode(x)), x * (1 + 1.0 / 2047)) << x;
}

TEST(OutwardScale, KeepsZeroZeroAndOrdersCodesAsMagnitudes) {
  const OutwardScale scale(50.0);
  EXPECT_EQ(scale.encode(0), 0);
  EXPECT_EQ(scale.decode(0), 0.0f);
  float last = -1;
  for (std::uint32_t code = 0; code <= OutwardScale::kMaxCode; ++code) {
    const float x = scale.decode(static_cast<OutwardScale::Code>(code));
    ASSERT_GT(x, last) << code;
    last = x;
  }
}

TEST(OutwardScale, EncodesItsOwnMagnitudesBackToTheirCodes) {
  const OutwardScale scale(1234.5);
  for (std::uint32_t code = 0; code <= OutwardScale::kMaxCode; ++code) {
    const auto c = static_cast<OutwardScale::Code>(code);
    ASSERT_EQ(scale.encode(scale.decode(c)), c);
    ASSERT_EQ(scale.floorCode(scale.decode(c)), c);
  }
}

TEST(OutwardScale, FloorsAnErrorToTheLargestCodeThatKeepsIt) {
  const OutwardScale scale(100.0);
  for (double x = 1e-4; x < 100; x *= 1.013) {
    const auto code = scale.floorCode(x);
    EXPECT_LE(double(scale.decode(code)), x);
    EXPECT_GT(double(scale.decode(static_cast<OutwardScale::Code>(code + 1))), x);
  }
  EXPECT_EQ(scale.floorCode(0), 0);
  EXPECT_EQ(scale.floorCode(INFINITY), OutwardScale::kMaxCode);
}

}  // namespace
}  // namespace arete
