// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/features/fixed_vertices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "datasets/families.h"

namespace arete {
namespace {

/// A plain with a roof on it: the ridge is a column, the eaves are creases too.
RasterHeightfield roof(std::uint32_t size) {
  RasterHeightfield field;
  field.columns = field.rows = size;
  for (std::uint32_t row = 0; row < size; ++row)
    for (std::uint32_t column = 0; column < size; ++column)
      field.heights.push_back(10 - std::abs(double(column) - double(size / 2)));
  return field;
}

FixedVertexOptions nothing() {
  FixedVertexOptions options;
  options.features.reset();
  return options;
}

TEST(FixedVertices, AreNoneWithoutAWish) {
  const auto chosen = chooseFixedVertices(roof(9), nothing());
  ASSERT_TRUE(chosen);
  EXPECT_TRUE(chosen->vertices.empty());
}

TEST(FixedVertices, AreTheMostPersistentFeaturesByCountAndByPersistence) {
  const RasterHeightfield field = rasterFamilies()[2].make(40, 30, 7);
  FixedVertexOptions options;
  options.features->count = 5;
  const auto few = chooseFixedVertices(field, options);
  ASSERT_TRUE(few);
  EXPECT_EQ(few->features, 5u);
  EXPECT_EQ(few->vertices.size(), 5u);
  EXPECT_TRUE(std::is_sorted(few->vertices.begin(), few->vertices.end()));

  options.features->count = std::numeric_limits<std::size_t>::max();
  options.features->minimumPersistence = 1e9;
  const auto none = chooseFixedVertices(field, options);
  ASSERT_TRUE(none);
  EXPECT_EQ(none->features, 0u);
}

TEST(FixedVertices, SnapGivenPositionsToTheNearestSampleOfTheDomain) {
  RasterHeightfield field = roof(9);
  field.georeference.geoTransform = {1000, 10, 0, 5000, 0, -10};
  field.heights[field.index(3, 3)] = std::numeric_limits<double>::quiet_NaN();
  FixedVertexOptions options = nothing();
  options.given = {field.georeference.toSource(6.2, 1.9),  // sample 6, 2
                   field.georeference.toSource(3.1, 3.2),  // beside the void: 4, 3 or 3, 4
                   field.georeference.toSource(20, 3),     // beside the raster
                   {std::numeric_limits<double>::quiet_NaN(), 0}};
  const auto chosen = chooseFixedVertices(field, options);
  ASSERT_TRUE(chosen);
  EXPECT_EQ(chosen->given, 2u);
  EXPECT_EQ(chosen->givenOutside, 2u);
  ASSERT_EQ(chosen->vertices.size(), 2u);
  EXPECT_EQ(chosen->vertices[0], field.index(6, 2));
  EXPECT_EQ(chosen->vertices[1], field.index(3, 4));
}

TEST(FixedVertices, SnapGivenPositionsToTheNearestPoint) {
  const PointHeightfield points = pointFamilies().front().make(300, 5);
  FixedVertexOptions options = nothing();
  double low = 1e300, high = -1e300;
  for (const Vec2& p : points.positions) {
    low = std::min(low, p.x);
    high = std::max(high, p.x);
  }
  for (std::size_t i = 0; i < points.size(); i += 37) {
    const Vec2 p = points.positions[i];
    options.given = {{p.x + 1e-7 * (high - low), p.y}};
    if (options.given.front().x > high) continue;
    const auto chosen = chooseFixedVertices(points, options);
    ASSERT_TRUE(chosen);
    ASSERT_EQ(chosen->vertices.size(), 1u);
    EXPECT_EQ(chosen->vertices.front(), i);
  }
  options.given = {{high + 1, 0}};
  const auto beside = chooseFixedVertices(points, options);
  ASSERT_TRUE(beside);
  EXPECT_EQ(beside->givenOutside, 1u);
}

TEST(FixedVertices, AreTheVerticesOnCreases) {
  const RasterHeightfield field = roof(9);
  FixedVertexOptions options = nothing();
  options.creaseAngleDegrees = 45;
  const auto chosen = chooseFixedVertices(field, options);
  ASSERT_TRUE(chosen);
  EXPECT_EQ(chosen->creases, 7u);  // the ridge without its ends, which are on the border
  for (const std::uint32_t v : chosen->vertices) EXPECT_EQ(v % field.columns, 4u);
  options.creaseAngleDegrees = 120;
  EXPECT_EQ(chooseFixedVertices(field, options)->creases, 0u);
}

TEST(FixedVertices, LeaveDegenerateRastersToTheBuildAndStopWhenAsked) {
  for (const RasterFamily& family : degenerateFamilies()) {
    const auto chosen = chooseFixedVertices(family.make(9, 9, 1), FixedVertexOptions{});
    ASSERT_TRUE(chosen) << family.name;
    EXPECT_TRUE(chosen->vertices.empty()) << family.name;
  }
  const std::atomic<bool> cancel = true;
  RunContext context;
  context.cancel = &cancel;
  const auto stopped = chooseFixedVertices(roof(9), FixedVertexOptions{}, context);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace arete
