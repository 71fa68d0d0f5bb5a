// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/crs/longitude_turns.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace arete {
namespace {

/// A global raster of degrees from `west`, one pixel per degree.
LongitudeTurns worldFrom(double west, std::uint32_t columns = 360) {
  Georeference georeference;
  georeference.isGeographic = true;
  georeference.geoTransform = {west, 1, 0, 90, 0, -1};
  return LongitudeTurns(georeference, columns, 180);
}

TEST(LongitudeTurns, ShiftPositionsOntoTheDem) {
  const LongitudeTurns turns = worldFrom(0);
  EXPECT_EQ(turns({-10, 5}), (Vec2{350, 5}));
  EXPECT_EQ(turns({370, 5}), (Vec2{10, 5}));
  EXPECT_EQ(turns({-730, 5}), (Vec2{350, 5}));
  EXPECT_EQ(turns({0, 5}), (Vec2{0, 5})) << "on a border";
  EXPECT_EQ(turns({360, 5}), (Vec2{360, 5})) << "on a border";
}

TEST(LongitudeTurns, BringAPositionBesideANarrowDemNearestToItsMiddle) {
  const LongitudeTurns turns = worldFrom(170, 20);  // 170 to 190
  std::mt19937 random(5);
  for (int i = 0; i < 1000; ++i) {
    const double x = double(random() % 144000) / 100 - 720;
    const Vec2 turned = turns({x, 1});
    EXPECT_EQ(std::remainder(turned.x - x, 360), 0) << x;
    EXPECT_LE(std::abs(turned.x - 180), 180) << x;
  }
}

TEST(LongitudeTurns, AreTheIdentityOnAMap) {
  EXPECT_EQ(LongitudeTurns()({1e9, 5}), (Vec2{1e9, 5}));
  Georeference map;
  map.geoTransform = {500000, 30, 0, 4000000, 0, -30};
  EXPECT_EQ(LongitudeTurns(map, 10, 10)({-117, 34}), (Vec2{-117, 34}));
}

TEST(LongitudeTurns, CountInTheUnitOfTheCrs) {
  Georeference grads;
  grads.isGeographic = true;
  grads.angularUnitRadians = 0.015707963267948967;
  grads.geoTransform = {0, 1, 0, 100, 0, -1};
  const Vec2 p = LongitudeTurns(grads, 400, 200)({-10, 5});
  EXPECT_NEAR(p.x, 390, 1e-9);
}

TEST(LongitudeTurns, ShiftAShapeAsAWhole) {
  const LongitudeTurns turns = worldFrom(0, 90);
  RegionShape beside;
  beside.rings = {{{361, 0}, {362, 0}, {362, 1}}};
  beside.lines = {{{370, 0}, {400, 0}}};
  turns.apply(beside);
  EXPECT_EQ(beside.rings[0][0], (Vec2{1, 0}));
  EXPECT_EQ(beside.lines[0][1], (Vec2{40, 0}));
  RegionShape across;  // reaches over the border of the DEM: parts of it would be torn apart
  across.lines = {{{-5, 0}, {5, 0}}};
  turns.apply(across);
  EXPECT_EQ(across.lines[0][0], (Vec2{-5, 0}));
  RegionShape empty;
  turns.apply(empty);
  EXPECT_TRUE(empty.rings.empty());
}

TEST(LongitudeTurns, OfPointsComeFromTheirExtent) {
  PointHeightfield field;
  field.georeference.isGeographic = true;
  field.positions = {{170, 0}, {190, 10}};
  field.heights = {0, 0};
  const LongitudeTurns turns(field);
  std::vector<Vec2> positions = {{-175, 5}, {175, 5}};
  turns.apply(positions);
  EXPECT_EQ(positions, (std::vector<Vec2>{{185, 5}, {175, 5}}));
}

}  // namespace
}  // namespace arete
