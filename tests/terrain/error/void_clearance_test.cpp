// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/error/void_clearance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace arete {
namespace {

/// Columns or rows, whichever are more, to the nearest sample without data: by a look at each of them.
std::int32_t toNearestVoid(const std::vector<double>& heights, std::uint32_t columns, std::uint32_t sample) {
  std::int32_t least = std::numeric_limits<std::int32_t>::max();
  const auto at = [&](std::size_t s) {
    return std::array{static_cast<std::int32_t>(s % columns), static_cast<std::int32_t>(s / columns)};
  };
  const auto from = at(sample);
  for (std::size_t s = 0; s < heights.size(); ++s) {
    if (!std::isnan(heights[s])) continue;
    const auto to = at(s);
    least = std::min(least, std::max(std::abs(to[0] - from[0]), std::abs(to[1] - from[1])));
  }
  return least;
}

TEST(VoidClearance, IsLessThanTheWayToTheNearestVoidAndNotMuchLess) {
  std::mt19937_64 random(20261122);
  for (int run = 0; run < 60; ++run) {
    const std::uint32_t columns = 1 + static_cast<std::uint32_t>(random() % 70),
                        rows = 1 + static_cast<std::uint32_t>(random() % 70);
    std::vector<double> heights(std::size_t(columns) * rows, 1);
    const int voids = 1 + static_cast<int>(random() % 4);
    for (int k = 0; k < voids; ++k) heights[random() % heights.size()] = std::nan("");
    const VoidClearance clearance(heights, columns);
    ASSERT_TRUE(clearance.hasVoids()) << "run " << run;
    for (std::uint32_t sample = 0; sample < heights.size(); ++sample) {
      const std::int32_t truth = toNearestVoid(heights, columns, sample);
      const std::int32_t found = clearance.at(sample % columns, sample / columns);
      EXPECT_LT(found, truth) << "run " << run << " sample " << sample;
      EXPECT_GE(found, truth - 4) << "run " << run << " sample " << sample;
    }
  }
}

TEST(VoidClearance, OfADistantVoidIsAsMuchAsItCanTell) {
  constexpr std::uint32_t kColumns = 3000;
  std::vector<double> heights(kColumns, 1);
  heights[0] = std::nan("");
  const VoidClearance clearance(heights, kColumns);
  EXPECT_EQ(clearance.at(kColumns - 1, 0), 506);
  EXPECT_LT(clearance.at(200, 0), 200);
  EXPECT_GT(clearance.at(200, 0), 190);
}

TEST(VoidClearance, HasNoBoundWithoutVoids) {
  const std::vector<double> heights(12, 1);
  const VoidClearance clearance(heights, 4);
  EXPECT_FALSE(clearance.hasVoids());
  EXPECT_EQ(clearance.at(3, 2), std::numeric_limits<std::int32_t>::max());
}

}  // namespace
}  // namespace arete
