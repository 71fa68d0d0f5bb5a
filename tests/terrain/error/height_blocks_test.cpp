// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every sample lies within the bounds of its block; on a plane the bounds are as narrow as floats allow.
#include "terrain/error/height_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace arete {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kMiddle = (HeightBlocks::kSide - 1) / 2.0;

double residual(const HeightBlocks::Block& block, double z, std::uint32_t column, std::uint32_t row) {
  const double x = column % HeightBlocks::kSide - kMiddle, y = row % HeightBlocks::kSide - kMiddle;
  return z - (double(block.middle) + double(block.slopeX) * x + double(block.slopeY) * y);
}

TEST(HeightBlocks, BoundEverySampleOfRastersOfAnySizeWithVoids) {
  for (const unsigned seed : {1u, 2u, 3u, 4u}) {
    std::mt19937 random(seed);
    for (const auto& [columns, rows] : {std::pair(1u, 1u), {8u, 8u}, {9u, 17u}, {40u, 33u}, {7u, 100u}})
      for (const unsigned voids : {0u, 3u, 50u, 100u}) {
        SCOPED_TRACE(testing::Message()
                     << "seed " << seed << ", " << columns << " x " << rows << ", " << voids << " % voids");
        const double offset = random() % 2 == 0 ? 0 : 8e6, relief = std::pow(10.0, int(random() % 8) - 3);
        std::vector<double> heights(std::size_t(columns) * rows);
        for (double& z : heights)
          z = random() % 100 < voids ? kNaN : offset + relief * double(random() % 1000) / 1000;
        const HeightBlocks blocks(heights, columns);
        for (std::uint32_t row = 0; row < rows; ++row)
          for (std::uint32_t column = 0; column < columns; ++column) {
            const double z = heights[std::size_t(row) * columns + column];
            const auto& block = blocks.at(column >> HeightBlocks::kShift, row >> HeightBlocks::kShift);
            if (std::isnan(z)) continue;
            ASSERT_GE(residual(block, z, column, row), double(block.low));
            ASSERT_LE(residual(block, z, column, row), double(block.high));
          }
      }
  }
}

TEST(HeightBlocks, AreEmptyWithoutAValidSample) {
  const std::vector<double> heights(64, kNaN);
  const HeightBlocks blocks(heights, 8);
  const auto& block = blocks.at(0, 0);
  EXPECT_GT(block.low, block.high);
}

TEST(HeightBlocks, FollowAPlaneAndExcludeNothingWhereFloatsOverflow) {
  std::vector<double> heights;
  for (int row = 0; row < 16; ++row)
    for (int column = 0; column < 24; ++column) heights.push_back(1000 + 3.5 * column - 0.25 * row);
  const HeightBlocks blocks(heights, 24);
  for (std::uint32_t row = 0; row < 2; ++row)
    for (std::uint32_t column = 0; column < 3; ++column) {
      const auto& block = blocks.at(column, row);
      EXPECT_EQ(block.slopeX, 3.5f);
      EXPECT_EQ(block.slopeY, -0.25f);
      EXPECT_NEAR(block.low, 0, 1e-3);
      EXPECT_NEAR(block.high, 0, 1e-3);
    }
  std::vector<double> huge(64, 1e300);
  huge[5] = -1e300;
  const HeightBlocks ofHuge(huge, 8);
  const auto& block = ofHuge.at(0, 0);
  EXPECT_EQ(block.low, -std::numeric_limits<float>::infinity());
  EXPECT_EQ(block.high, std::numeric_limits<float>::infinity());
}

}  // namespace
}  // namespace arete
