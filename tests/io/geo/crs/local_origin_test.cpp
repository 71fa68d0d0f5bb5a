// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/crs/local_origin.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace arete {
namespace {

TEST(LocalOrigin, IsAVertexNearTheMiddleAndHeightZeroForHeightsThatFloatsHold) {
  std::vector<Vec3> vertices;
  EXPECT_EQ(localOrigin(vertices), Vec3{});
  for (int i = 0; i <= 10; ++i) vertices.push_back({1e6 + i / 3.0, -5e6 + i, 9000.5 + i});
  EXPECT_EQ(localOrigin(vertices), (Vec3{1e6 + 5 / 3.0, -5e6 + 5, 0}));
}

TEST(LocalOrigin, LeavesZeroForHeightsThatFloatsWouldRound) {
  std::vector<Vec3> vertices;
  for (int i = 0; i <= 10; ++i) vertices.push_back({0, 0, 1e7 + i / 7.0});
  EXPECT_EQ(localOrigin(vertices).z, 1e7 + 5 / 7.0);
  vertices.push_back({0, 0, -1e7});
  EXPECT_EQ(localOrigin(vertices).z, 0);
}

TEST(Float32Rounding, BoundsTheWayToFloatAndBack) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> position(-5e6, 5e6), offset(-3e4, 3e4);
  for (int i = 0; i < 10000; ++i) {
    const double origin = position(random), x = origin + offset(random);
    const double back = origin + static_cast<double>(static_cast<float>(x - origin));
    EXPECT_LE(std::abs(back - x), float32Rounding(std::abs(x - origin), origin));
  }
}

}  // namespace
}  // namespace arete
