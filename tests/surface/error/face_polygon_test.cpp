// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/error/face_polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace arete {
namespace {

constexpr std::uint32_t kOne = FacePoint::kOne;

FacePoint anywhere(std::mt19937_64& random) {
  const auto u = static_cast<std::uint32_t>(random() % (kOne + 1));
  return {u, static_cast<std::uint32_t>(random() % (kOne - u + 1))};
}

/// Twice the signed area of three points, in 128 bits.
__int128 turn(const FacePoint& a, const FacePoint& b, const FacePoint& c) {
  return (__int128(b.u) - a.u) * (__int128(c.v) - a.v) - (__int128(b.v) - a.v) * (__int128(c.u) - a.u);
}

TEST(FacePolygon, HullIsConvexAndHoldsEveryPoint) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 300; ++i) {
    FacePolygon points;
    for (std::uint64_t k = 0; k < 3 + random() % 12; ++k) points.push_back(anywhere(random));
    FacePolygon hull = points;
    takeConvexHull(hull);
    ASSERT_GE(hull.size(), 3u);
    for (std::size_t k = 0; k < hull.size(); ++k) {
      const FacePoint &a = hull[k], &b = hull[(k + 1) % hull.size()];
      EXPECT_TRUE(std::ranges::find(points, a) != points.end());
      EXPECT_GT(turn(a, b, hull[(k + 2) % hull.size()]), 0);
      for (const FacePoint& p : points) EXPECT_GE(turn(a, b, p), 0);
    }
  }
}

TEST(FacePolygon, HullOfTheCornersIsTheWholeFaceHoweverManyPointsAreInside) {
  FacePolygon points = {{5, 5}, {0, kOne}, {kOne / 2, kOne / 2}, {0, 0}, {kOne, 0}, {77, 0}};
  takeConvexHull(points);
  EXPECT_TRUE(isWholeFace(points));
  FacePolygon onLine = {{0, 0}, {10, 10}, {4, 4}};
  takeConvexHull(onLine);
  EXPECT_EQ(onLine.size(), 2u);
}

TEST(FacePolygon, CutPartsShareTheirNewCornersAndCoverTheWhole) {
  std::mt19937_64 random(8);
  for (int i = 0; i < 300; ++i) {
    FacePolygon polygon;
    for (int k = 0; k < 6; ++k) polygon.push_back(anywhere(random));
    takeConvexHull(polygon);
    const double a = double(random() % 2001) - 1000, b = double(random() % 2001) - 1000;
    const FacePoint through = anywhere(random);
    std::vector<double> heights;
    for (const FacePoint& p : polygon)
      heights.push_back(a * (double(p.u) - through.u) + b * (double(p.v) - through.v));
    FacePolygon below, above;
    cut(polygon, heights, below, above);
    const std::int64_t whole = twiceArea(polygon), parts = (below.size() > 2 ? twiceArea(below) : 0) +
                                                           (above.size() > 2 ? twiceArea(above) : 0);
    // A new corner is rounded by half a unit, along at most the face's side.
    EXPECT_NEAR(double(parts), double(whole), 4.0 * kOne);
    for (const FacePoint& p : polygon)
      EXPECT_TRUE(std::ranges::find(below, p) != below.end() || std::ranges::find(above, p) != above.end());
    std::size_t common = 0;
    for (const FacePoint& p : below) common += std::ranges::count(above, p);
    EXPECT_TRUE(below.empty() || above.empty() || common > 0);
  }
}

TEST(FacePolygon, CornersHaveTheirPlacesToTheBit) {
  const SpaceTriangle face{Vec3{0.1, 1e9, 3}, Vec3{7.3, -0.2, 5}, Vec3{1e-9, 4, 1.0 / 3}};
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(placeOf(wholeFace()[i], face), face[i]);
}

}  // namespace
}  // namespace arete
