// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/error/sample_heights.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <type_traits>
#include <vector>

namespace arete {
namespace {

constexpr std::size_t kSamples = 100'003;  // more than a thread takes at once
constexpr double kVoid = std::numeric_limits<double>::quiet_NaN();

bool areFloats(const SampleHeights& heights) {
  return heights.with([](const auto* first) { return std::is_same_v<decltype(first), const float*>; });
}

/// The same numbers, bit for bit, but for which NaN it is.
void expectSame(const SampleHeights& heights, const std::vector<double>& expected) {
  ASSERT_EQ(heights.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const double one = heights[i],
                 other = heights.with([i](const auto*first) { return static_cast<double>(first[i]); });
    ASSERT_EQ(std::isnan(one), std::isnan(expected[i])) << i;
    if (std::isnan(expected[i])) continue;
    ASSERT_EQ(std::bit_cast<std::uint64_t>(one), std::bit_cast<std::uint64_t>(expected[i])) << i;
    ASSERT_EQ(std::bit_cast<std::uint64_t>(other), std::bit_cast<std::uint64_t>(expected[i])) << i;
  }
}

/// Whole metres, floats of either sign, zeros of either sign and voids.
std::vector<double> ofFloats(std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<double> heights(kSamples);
  for (double& z : heights) {
    const auto any = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
    const double kinds[] = {double(int(random() % 9000) - 400), std::isfinite(any) ? double(any) : 1.5, -0.0,
                            kVoid};
    z = kinds[random() % 4];
  }
  return heights;
}

TEST(SampleHeights, AreFloatsWhereTheseAreTheSameNumbers) {
  const std::uint32_t seed = 29;
  SCOPED_TRACE(seed);
  const std::vector<double> heights = ofFloats(seed);
  const SampleHeights some(heights);
  EXPECT_TRUE(areFloats(some));
  expectSame(some, heights);
}

TEST(SampleHeights, AreDoublesWhereASingleOneIsNoFloat) {
  for (const double odd : {0.1, 16'777'217.0, 1e300, 4e6 + 1e-9})
    for (const std::size_t at : {std::size_t(0), kSamples / 2, kSamples - 1}) {
      std::vector<double> heights = ofFloats(31);
      heights[at] = odd;
      const SampleHeights some(heights);
      EXPECT_FALSE(areFloats(some)) << odd << " at " << at;
      expectSame(some, heights);
    }
}

TEST(SampleHeights, OfVoidsAloneAreVoids) {
  const std::vector<double> heights(17, kVoid);
  expectSame(SampleHeights(heights), heights);
}

}  // namespace
}  // namespace arete
