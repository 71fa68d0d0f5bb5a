// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/crs/longitude_turns.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>
#include <vector>

#include "io/georeference_fixture.h"

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

TEST(LongitudeTurns, NameEveryShiftThatMeetsTheDem) {
  using Shifts = std::vector<double>;
  const LongitudeTurns fiji = worldFrom(179, 2);  // 179 to 181
  EXPECT_EQ(fiji.shiftsOnto(-180, 180), (Shifts{0, 360})) << "cut at the antimeridian: both parts count";
  EXPECT_EQ(fiji.shiftsOnto(-180, -179.5), (Shifts{360}));
  EXPECT_EQ(fiji.shiftsOnto(179.5, 180.5), (Shifts{0}));
  EXPECT_EQ(fiji.shiftsOnto(539.5, 540.5), (Shifts{-360}));
  EXPECT_EQ(fiji.shiftsOnto(0, 10), Shifts{});
  const LongitudeTurns east = worldFrom(0, 360);
  EXPECT_EQ(east.shiftsOnto(-5, 5), (Shifts{0, 360}));
  EXPECT_EQ(east.shiftsOnto(350, 370), (Shifts{-360, 0}));
  EXPECT_EQ(east.shiftsOnto(10, 20), (Shifts{0}));
  EXPECT_EQ(LongitudeTurns().shiftsOnto(-1e9, 1e9), (Shifts{0}));
  EXPECT_EQ(fiji.shiftsOnto(1, 0), (Shifts{0})) << "of no shape";
}

TEST(LongitudeTurns, AreThoseOfCylindricalMapsToo) {
  const double turn = 2 * std::numbers::pi * 6378137;
  EXPECT_NEAR(turnOf(test::georeferenceOf("EPSG:3857")), turn, 1e-6);
  EXPECT_NEAR(turnOf(test::georeferenceOf("EPSG:3395")), turn, 1e-6);
  EXPECT_NEAR(turnOf(test::georeferenceOf("EPSG:3832")), turn, 1e-6) << "about 150 degrees east";
  EXPECT_NEAR(turnOf(test::georeferenceOf("EPSG:4087")), turn, 1e-6);
  EXPECT_NEAR(turnOf(test::georeferenceOf("+proj=merc +lon_0=-100 +R=1000 +units=km +type=crs")),
              2 * std::numbers::pi, 1e-9);
  EXPECT_EQ(turnOf(test::georeferenceOf("EPSG:4326")), 360);
  EXPECT_NEAR(turnOf(test::georeferenceOf("EPSG:4807")), 400, 1e-9) << "grads";
  for (const char* crs : {"EPSG:32601", "EPSG:3035", "EPSG:3413", "ESRI:54030"})
    EXPECT_EQ(turnOf(test::georeferenceOf(crs)), 0) << crs;
  EXPECT_EQ(turnOf({}), 0);
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
