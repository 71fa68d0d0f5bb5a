// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/error/floor_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace arete {
namespace {

TEST(FloorDistance, IsThatOfTheNearestPointOfEachTriangle) {
  std::mt19937_64 random(5);
  const auto number = [&] { return double(random() % 2001) / 500 - 2; };
  const auto point = [&] { return Vec3{number(), number(), number()}; };
  for (int i = 0; i < 500; ++i) {
    FloorDistance floor;
    std::vector<SpaceTriangle> triangles;
    for (std::uint64_t k = 0; k < 1 + random() % 32; ++k) {
      triangles.push_back({point(), point(), point()});
      if (k % 10 == 3)
        triangles.back()[2] = triangles.back()[0] * 0.5 + triangles.back()[1] * 0.5;  // no area
      floor.add(triangles.back());
    }
    for (int k = 0; k < 10; ++k) {
      const Vec3 p = k % 5 == 0 ? triangles[0][1] : point();
      FloorDistance::Squares squares;
      floor.squares(p, squares);
      double least = 1e9;
      for (std::size_t t = 0; t < triangles.size(); ++t) {
        EXPECT_NEAR(std::sqrt(squares[t]), distanceToTriangle(p, triangles[t]), 1e-7);
        least = std::min(least, squares[t]);
      }
      EXPECT_EQ(floor.nearest(p), least);
    }
  }
}

TEST(FloorDistance, OfACornerIsZero) {
  FloorDistance floor;
  floor.add({Vec3{0.1, 0.2, 0.3}, Vec3{4.7, -1.1, 2.2}, Vec3{-3.3, 5.5, 0.7}});
  EXPECT_EQ(floor.nearest({0.1, 0.2, 0.3}), 0);
}

}  // namespace
}  // namespace arete
