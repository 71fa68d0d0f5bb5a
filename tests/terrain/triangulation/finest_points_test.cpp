// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/triangulation/finest_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <vector>

#include "datasets/families.h"

namespace arete {
namespace {

TEST(FinestPoints, HasTheTrianglesOfTheEulerRelation) {
  for (const PointFamily& family : pointFamilies()) {
    const PointHeightfield field = family.make(500, 8);
    const auto finest = finestPoints(field);
    ASSERT_TRUE(finest) << family.name;
    const auto triangles = finest->trianglesOfPoints();
    // Counter-clockwise everywhere, and no vertex left out but exact repeats.
    std::vector<char> seen(field.size(), 0);
    for (const auto& t : triangles)
      for (const std::uint32_t v : t) seen[v] = 1;
    std::size_t used = 0;
    for (const char s : seen) used += s;
    EXPECT_LE(triangles.size(), 2 * used);
    EXPECT_GE(used, 3u) << family.name;
  }
}

TEST(FinestPoints, StopsWhenAsked) {
  const std::atomic<bool> cancel = true;
  RunContext context;
  context.cancel = &cancel;
  const auto stopped = finestPoints(pointFamilies().front().make(500, 8), context);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::interrupted);
}

TEST(FinestPoints, LooksForNoPointAmongAllOfALine) {
  PointHeightfield field;  // minutes, if it did
  for (int i = 0; i < 300'000; ++i) field.positions.push_back({0.25 * i, 0});
  field.heights.assign(field.positions.size(), 1);
  const auto line = finestPoints(field);
  ASSERT_FALSE(line);
  EXPECT_EQ(line.error().code, ErrorCode::degenerate);
  field.positions.push_back({80'000, 1});
  field.heights.push_back(2);
  const auto fan = finestPoints(field);
  ASSERT_TRUE(fan);
  EXPECT_EQ(fan->triangles.size(), 299'999u);
}

TEST(FinestPoints, NamesTwoPointsAtOnePositionWithTwoHeights) {
  PointHeightfield field;
  field.positions = {{0, 0}, {4, 0}, {0, 3}, {4, 0}};
  field.heights = {1, 2, 3, 2};
  const auto repeated = finestPoints(field);
  ASSERT_TRUE(repeated) << "an exact repeat is left out";
  EXPECT_EQ(repeated->triangles.size(), 1u);
  field.heights[3] = 5;
  const auto twice = finestPoints(field);
  ASSERT_FALSE(twice);
  EXPECT_EQ(twice.error().code, ErrorCode::degenerate);
  EXPECT_NE(twice.error().message.find("points 1 and 3"), std::string::npos) << twice.error().message;
}

TEST(FinestPoints, ListsTrianglesSortedFromTheirLeastCorner) {
  const auto finest = finestPoints(pointFamilies().front().make(300, 2));
  ASSERT_TRUE(finest);
  EXPECT_TRUE(std::ranges::is_sorted(finest->triangles));
  for (const auto& t : finest->triangles) {
    EXPECT_LT(t[0], t[1]);
    EXPECT_LT(t[0], t[2]);
  }
  std::vector<std::uint32_t> order = finest->order;
  std::ranges::sort(order);
  for (std::uint32_t i = 0; i < order.size(); ++i) EXPECT_EQ(order[i], i) << "a permutation";
}

}  // namespace
}  // namespace arete
