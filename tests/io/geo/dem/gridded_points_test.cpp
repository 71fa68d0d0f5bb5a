// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/dem/gridded_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace arete {
namespace {

/// The points of a grid in a shuffled order; height = 100 column + row from the south.
PointHeightfield gridOf(int columns, int rows, double step = 30, double x = 500000, double y = 4e6) {
  PointHeightfield points;
  std::vector<int> order;
  for (int i = 0; i < columns * rows; ++i) order.push_back(i);
  std::shuffle(order.begin(), order.end(), std::mt19937(1));
  for (const int i : order) {
    points.positions.push_back({x + step * (i % columns), y + step * (i / columns)});
    points.heights.push_back(100 * (i % columns) + i / columns);
  }
  return points;
}

void erase(PointHeightfield& points, std::size_t i) {
  points.positions.erase(points.positions.begin() + std::ptrdiff_t(i));
  points.heights.erase(points.heights.begin() + std::ptrdiff_t(i));
}

TEST(GriddedPoints, BecomeANorthUpRaster) {
  const auto raster = asRaster(gridOf(4, 3));
  ASSERT_TRUE(raster);
  EXPECT_EQ(raster->columns, 4u);
  EXPECT_EQ(raster->rows, 3u);
  EXPECT_EQ(raster->at(0, 0), 2) << "the north-western sample";
  EXPECT_EQ(raster->at(3, 2), 300);
  EXPECT_EQ(raster->georeference.toSource(0, 2), (Vec2{500000, 4e6}));
  EXPECT_EQ(raster->georeference.toSource(3, 0), (Vec2{500090, 4000060}));
}

TEST(GriddedPoints, MayMissSamples) {
  PointHeightfield points = gridOf(6, 6);
  for (int i = 0; i < 8; ++i) erase(points, 5);
  const auto raster = asRaster(points);
  ASSERT_TRUE(raster);
  EXPECT_EQ(std::ranges::count_if(raster->heights, [](double h) { return std::isnan(h); }), 8);
}

TEST(GriddedPoints, MayBeRoundedByAPercentOfAStep) {
  for (const double rounding : {0.009, 0.02}) {
    PointHeightfield points = gridOf(10, 10, 1, 0, 0);
    for (std::size_t i = 0; i < points.positions.size(); ++i)
      if (points.positions[i].x == 5) points.positions[i].x += rounding;
    EXPECT_EQ(asRaster(points).has_value(), rounding < 0.01) << rounding;
  }
}

TEST(GriddedPoints, AreNotScatteredOnes) {
  PointHeightfield scattered;
  std::mt19937 random(2);
  for (int i = 0; i < 200; ++i) {
    scattered.positions.push_back({double(random()) / 1e4, double(random()) / 1e4});
    scattered.heights.push_back(0);
  }
  EXPECT_FALSE(asRaster(scattered));
  EXPECT_FALSE(asRaster({}));
  EXPECT_FALSE(asRaster(gridOf(3, 1))) << "one row";
}

TEST(GriddedPoints, AreNotACheckerboard) {
  PointHeightfield points;
  for (int column = 0; column < 20; ++column)
    for (int row = 0; row < 20; ++row)
      if ((column + row) % 2 == 0) {
        points.positions.push_back({double(column), double(row)});
        points.heights.push_back(0);
      }
  EXPECT_FALSE(asRaster(points)) << "no cell has three samples";
}

TEST(GriddedPoints, AtTheLimitsOfDoublesHaveNoStep) {
  PointHeightfield points;
  for (const double x : {-1.7e308, 1.7e308})
    for (const double y : {0.0, 1.0}) {
      points.positions.push_back({x, y});
      points.heights.push_back(0);
    }
  EXPECT_FALSE(asRaster(points));
}

}  // namespace
}  // namespace arete
