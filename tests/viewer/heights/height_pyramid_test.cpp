// SPDX-License-Identifier: GPL-3.0-or-later
//
// The heights, slopes and aspects that are painted on the ground, against the triangles of the terrain and
// against plain sums over its samples.
#include "viewer/heights/height_pyramid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "datasets/families.h"
#include "datasets/random.h"
#include "terrain/builder/build.h"
#include "terrain/locate/ground_height.h"

namespace arete {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

RasterHeightfield rasterOf(std::uint32_t columns, std::uint32_t rows, const std::array<double, 6>& g,
                           const auto& height) {
  RasterHeightfield field;
  field.columns = columns;
  field.rows = rows;
  field.georeference.geoTransform = g;
  field.georeference.hasGeoTransform = true;
  for (std::uint32_t row = 0; row < rows; ++row)
    for (std::uint32_t column = 0; column < columns; ++column) {
      const Vec2 xy = field.georeference.toSource(column, row);
      field.heights.push_back(height(xy.x, xy.y));
    }
  return field;
}

HeightPyramid pyramidOf(const TerrainModel& model, const PyramidOptions& options = {}) {
  Result<HeightPyramid> pyramid = HeightPyramid::create(model, options);
  EXPECT_TRUE(pyramid) << pyramid.error().describe();
  return std::move(*pyramid);
}

TerrainModel built(const RasterHeightfield& field) {
  Result<TerrainModel> model = build(field);
  EXPECT_TRUE(model) << model.error().describe();
  return std::move(*model);
}

double degreesOf(const HeightPyramid::Ground& g) {
  return 90.0 * g.slope / g.covered;
}

TEST(HeightPyramid, HeightsAreThoseOfTheFinestTrianglesEverywhere) {
  for (const RasterFamily& family : rasterFamilies())
    for (const auto& [columns, rows] : {std::pair(2u, 2u), {17u, 9u}, {40u, 31u}}) {
      SCOPED_TRACE(std::string(family.name) + " " + std::to_string(columns) + " seed 5");
      const TerrainModel model = built(family.make(columns, rows, 5));
      const HeightPyramid pyramid = pyramidOf(model);
      EXPECT_TRUE(pyramid.isExact());
      const GroundHeights heights(model);
      Random random(5);
      for (int i = 0; i < 400; ++i) {
        const Vec2 plan{random.between(0, columns - 1.0), random.between(0, rows - 1.0)};
        const auto expected = heights.at(model.toSource(plan));
        const auto got = pyramid.heightAt(plan);
        ASSERT_EQ(expected.has_value(), got.has_value()) << plan.x << ", " << plan.y;
        ASSERT_NEAR(got.value_or(0), expected ? expected->height : 0, 1e-5 * (1 + pyramid.reach()));
      }
    }
}

TEST(HeightPyramid, ACoarseNodeHasTheMeanOfWhatHasDataBelowIt) {
  for (const RasterFamily& family : rasterFamilies()) {
    SCOPED_TRACE(std::string(family.name) + " seed 3");
    RasterHeightfield field = family.make(75, 50, 3);
    const TerrainModel model = built(field);
    const HeightPyramid pyramid = pyramidOf(model);
    ASSERT_EQ(pyramid.levels().size(), 3u);
    const HeightPyramid::Level &fine = pyramid.levels()[0], &coarse = pyramid.levels()[2];
    for (std::uint32_t row = 0; row < coarse.rows; ++row)
      for (std::uint32_t column = 0; column < coarse.columns; ++column) {
        double heights = 0, slopes = 0, east = 0, north = 0;
        int count = 0;
        for (std::uint32_t y = 4 * row; y < std::min(4 * row + 4, field.rows); ++y)
          for (std::uint32_t x = 4 * column; x < std::min(4 * column + 4, field.columns); ++x) {
            const std::size_t i = std::size_t(y) * fine.columns + x;
            if (fine.heights[i] == HeightPyramid::kNone) continue;
            heights += field.at(x, y);
            slopes += fine.ground[i].slope, east += fine.ground[i].east, north += fine.ground[i].north;
            ++count;
          }
        const std::size_t i = std::size_t(row) * coarse.columns + column;
        const HeightPyramid::Ground& g = coarse.ground[i];
        if (count == 0) {
          ASSERT_EQ(coarse.heights[i], HeightPyramid::kNone);
          ASSERT_EQ(g.covered, 0);
          continue;
        }
        ASSERT_NEAR(double(coarse.heights[i]) + pyramid.base(), heights / count,
                    1e-3 * (1 + pyramid.reach()));
        ASSERT_NEAR(g.covered / HeightPyramid::kOne, count / 16.0, 1e-4);
        ASSERT_NEAR(g.slope, slopes / 16, 2);
        ASSERT_NEAR(g.east, east / 16, 2);
        ASSERT_NEAR(g.north, north / 16, 2);
      }
  }
}

TEST(HeightPyramid, AroundVoidsMeansAreOfTheGroundAlone) {
  const auto field = rasterOf(90, 90, {0, 30, 0, 0, 0, -30}, [](double x, double y) {
    return std::hypot(x - 1300, y + 1200) < 500 || std::sin(x * y) > 0.9 ? std::nan("") : 417.0;
  });
  const HeightPyramid pyramid = pyramidOf(built(field));
  for (const HeightPyramid::Level& level : pyramid.levels())
    for (std::size_t i = 0; i < level.heights.size(); ++i)
      if (level.heights[i] != HeightPyramid::kNone) {
        ASSERT_EQ(double(level.heights[i]) + pyramid.base(), 417);
        ASSERT_EQ(level.ground[i].slope, 0);
        ASSERT_EQ(level.ground[i].east, 0);
      }
}

// A plane on the ground that falls by so much a metre to the south-east, on maps of all kinds.
TEST(HeightPyramid, SlopesAreInMetresOfTheGroundWhateverTheMapAndItsUnits) {
  constexpr double kRise = 0.25, kFoot = 0.3048;
  const double angle = std::atan(kRise) / kDegree;
  const auto check = [&](const RasterHeightfield& field, const std::string& name, double within = 0.05) {
    SCOPED_TRACE(name);
    const HeightPyramid pyramid = pyramidOf(built(field));
    for (const HeightPyramid::Ground& g : pyramid.levels()[0].ground) {
      ASSERT_NEAR(degreesOf(g), angle, within);
      ASSERT_NEAR(std::atan2(g.east, g.north) / kDegree, 135, 0.3);
    }
  };
  const double part = kRise * std::sqrt(0.5);
  const auto plane = [&](double x, double y) { return 500 - part * x + part * y; };
  check(rasterOf(20, 30, {0, 30, 0, 0, 0, -30}, plane), "metres");
  check(rasterOf(20, 30, {0, 30, 0, 0, 0, 30}, plane), "south up");
  check(rasterOf(20, 30, {0, 25, 9, 0, 12, -31}, plane), "turned and sheared");
  RasterHeightfield feet =
      rasterOf(20, 30, {0, 30, 0, 0, 0, -30}, [&](double x, double y) { return plane(x, y) / kFoot; });
  feet.georeference.verticalUnitMetres = kFoot;
  feet.georeference.verticalUnit = "ft";
  check(feet, "heights in feet");
  // Of degrees: from 70 to 50 degrees north a column is from 38 to 72 km wide.
  RasterHeightfield degrees = rasterOf(5, 41, {0, 1e-3, 0, 70, 0, -0.5}, [](double, double) { return 0.0; });
  degrees.georeference.isGeographic = true;
  degrees.georeference.crsWkt = "a geographic CRS";
  for (std::uint32_t row = 0; row < 41; ++row)
    for (std::uint32_t column = 0; column < 5; ++column) {
      const double y = degrees.georeference.toSource(column, row).y * kDegree;
      constexpr double kAxis = 6378137, kSquare = 0.00669437999;
      const double metres =
          kAxis / std::sqrt(1 - kSquare * std::sin(y) * std::sin(y)) * std::cos(y) * 1e-3 * kDegree;
      degrees.heights[row * 5 + column] = -kRise * metres * column;
    }
  const HeightPyramid pyramid = pyramidOf(built(degrees));
  for (const HeightPyramid::Ground& g : pyramid.levels()[0].ground) ASSERT_NEAR(degreesOf(g), angle, 0.02);
}

TEST(HeightPyramid, AspectsOfARidgeCancel) {
  const auto field =
      rasterOf(64, 64, {0, 10, 0, 0, 0, -10}, [](double x, double) { return -std::abs(x - 320) * 0.6; });
  const HeightPyramid pyramid = pyramidOf(built(field));
  const HeightPyramid::Level& coarsest = pyramid.levels().back();
  double east = 0, slope = 0, covered = 0;
  for (const HeightPyramid::Ground& g : coarsest.ground)
    east += g.east, slope += g.slope, covered += g.covered;
  EXPECT_LT(std::abs(east / covered), 0.02);
  EXPECT_NEAR(90 * slope / covered, std::atan(0.6) / kDegree, 1);
}

TEST(HeightPyramid, PointsAreResampledFromTheirFinestTriangles) {
  for (const PointFamily& family : pointFamilies()) {
    SCOPED_TRACE(std::string(family.name) + " seed 11");
    auto model = build(family.make(300, 11));
    ASSERT_TRUE(model);
    const HeightPyramid pyramid = pyramidOf(*model);
    EXPECT_FALSE(pyramid.isExact());
    const GroundHeights heights(*model);
    const HeightPyramid::Level& level = pyramid.levels()[0];
    std::size_t compared = 0;
    for (std::uint32_t row = 0; row < level.rows; row += 3)
      for (std::uint32_t column = 0; column < level.columns; column += 3) {
        const Vec2 plan{(column - pyramid.shift().x) / pyramid.scale().x,
                        (row - pyramid.shift().y) / pyramid.scale().y};
        const auto expected = heights.at(plan);
        const float got = level.heights[std::size_t(row) * level.columns + column];
        if (!expected) continue;
        ++compared;
        ASSERT_NEAR(double(got) + pyramid.base(), expected->height, 1e-4 * (1 + pyramid.reach()));
      }
    EXPECT_GT(compared, 10u);
  }
}

TEST(HeightPyramid, ManyPointsWidenTheStep) {
  auto model = build(pointFamilies()[0].make(500, 2));
  ASSERT_TRUE(model);
  const HeightPyramid pyramid = pyramidOf(*model, {.mostNodes = 900});
  EXPECT_LE(pyramid.levels()[0].heights.size(), 900u);
  EXPECT_GT(pyramid.levels()[0].heights.size(), 500u);
}

}  // namespace
}  // namespace arete
