// SPDX-License-Identifier: GPL-3.0-or-later
#include "gis/driver/pixel_grid.h"

#include <gtest/gtest.h>

#include <cmath>

namespace arete {
namespace {

/// Two triangles over the pixels from (0.5, 0.5) to (4.5, 4.5), of heights x + 10 y.
TriangleBins square() {
  GridTriangles triangles;
  for (const Vec2 p : {Vec2{0.5, 0.5}, {4.5, 0.5}, {4.5, 4.5}, {0.5, 4.5}})
    triangles.corners.push_back({p, p.x + 10 * p.y});
  triangles.triangles = {{0, 1, 2}, {0, 3, 2}};  // of both orientations
  return TriangleBins(std::move(triangles));
}

TEST(TriangleBins, FillsSamplesOnCornersAndEdges) {
  std::vector<double> heights(25);
  square().fill({0, 0, 5, 5, 5, 5}, heights);
  for (int row = 0; row < 5; ++row)
    for (int column = 0; column < 5; ++column)
      EXPECT_DOUBLE_EQ(heights[std::size_t(row * 5 + column)], column + 0.5 + 10 * (row + 0.5));
}

TEST(TriangleBins, FillsNothingBeyondTheTriangles) {
  std::vector<double> heights(100);
  square().fill({-2.5, -2.5, 10, 10, 10, 10}, heights);
  int known = 0;
  for (const double height : heights) known += std::isnan(height) ? 0 : 1;
  EXPECT_EQ(known, 16);  // whole numbers from 1 to 4 both ways
}

TEST(TriangleBins, FillsWindowsFinerAndCoarserThanPixels) {
  std::vector<double> heights(400);
  square().fill({1, 1, 2, 2, 20, 20}, heights);
  EXPECT_NEAR(heights[20 * 7 + 3], 1 + 0.35 + 10 * (1 + 0.75), 1e-12);
  heights.resize(1);
  square().fill({1, 1, 3, 3, 1, 1}, heights);
  EXPECT_NEAR(heights[0], 2.5 + 25, 1e-12);
}

TEST(TriangleBins, OfNoTriangleHaveNoHeight) {
  std::vector<double> heights(4, 1);
  TriangleBins(GridTriangles{}).fill({0, 0, 2, 2, 2, 2}, heights);
  for (const double height : heights) EXPECT_TRUE(std::isnan(height));
}

}  // namespace
}  // namespace arete
