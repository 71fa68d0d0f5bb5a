// SPDX-License-Identifier: GPL-3.0-or-later
//
// Grid and source coordinates there and back; steps on the ground against closed forms on a sphere.
#include "terrain/model/georeference.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "datasets/random.h"

namespace arete {
namespace {

TEST(Georeference, GoesFromTheGridToTheSourceAndBack) {
  for (const std::array<double, 6>& transform : {std::array<double, 6>{0, 1, 0, 0, 0, 1},
                                                 {376000.5, 30, 0, 3.8e6, 0, -30},
                                                 {7.9, 0.00083, 0, 47, 0, -0.00083},
                                                 {1000, 20, 7, 5000, 6, -19}}) {
    Georeference g;
    g.geoTransform = transform;
    Random random(1);
    for (int k = 0; k < 100; ++k) {
      const double column = random.between(-10, 2000), row = random.between(-10, 2000);
      const Vec2 source = g.toSource(column, row), grid = g.toGrid(source.x, source.y);
      EXPECT_NEAR(grid.x, column, 1e-7);
      EXPECT_NEAR(grid.y, row, 1e-7);
    }
    // The centre of the first pixel is sample (0, 0).
    EXPECT_DOUBLE_EQ(g.toSource(0, 0).x, transform[0] + (transform[1] + transform[2]) / 2);
    EXPECT_DOUBLE_EQ(g.toSource(0, 0).y, transform[3] + (transform[4] + transform[5]) / 2);
    EXPECT_DOUBLE_EQ(g.determinant(), transform[1] * transform[5] - transform[2] * transform[4]);
  }
}

TEST(GroundStep, OnAMapIsTheLengthOfTheTransformsColumnsInMetres) {
  Georeference g;
  g.geoTransform = {0, 3, 5, 0, 4, -12};
  EXPECT_EQ(groundStep(g, 7, 9), (Vec2{5, 13}));
  g.linearUnitMetres = 0.3048;
  EXPECT_EQ(groundStep(g, 7, 9), (Vec2{5, 13})) << "without a CRS, units have no length";
  g.crsWkt = "of a map in feet";
  EXPECT_NEAR(groundStep(g, 7, 9).x, 5 * 0.3048, 1e-12);
  EXPECT_NEAR(groundStep(g, 7, 9).y, 13 * 0.3048, 1e-12);
}

TEST(GroundStep, OnASphereIsAnArcOfItsParallelAndItsMeridian) {
  constexpr double kRadius = 1737400;  // the Moon
  Georeference g;
  g.crsWkt = "of longitude and latitude";
  g.isGeographic = true;
  g.semiMajorAxisMetres = kRadius;
  g.inverseFlattening = 0;
  constexpr double kStep = 1.0 / 1200, kRadians = std::numbers::pi / 180;
  for (const double latitude : {0.0, 30.0, 47.5, -60.0, 85.0}) {
    g.geoTransform = {10, kStep, 0, latitude, 0, -kStep};
    const Vec2 step = groundStep(g, -0.5, -0.5);
    EXPECT_NEAR(step.x, kRadius * std::cos(latitude * kRadians) * kStep * kRadians, 1e-5) << latitude;
    EXPECT_NEAR(step.y, kRadius * kStep * kRadians, 1e-5) << latitude;
    const Vec2 unit = groundUnit(g, latitude);
    EXPECT_NEAR(unit.x, step.x / kStep, 1e-8 * step.x / kStep) << latitude;
    EXPECT_NEAR(unit.y, step.y / kStep, 1e-8 * step.y / kStep) << latitude;
  }
  // The same ground in gons.
  g.angularUnitRadians = std::numbers::pi / 200;
  g.geoTransform = {10, kStep / 0.9, 0, 45 / 0.9, 0, -kStep / 0.9};
  EXPECT_NEAR(groundStep(g, -0.5, -0.5).y, kRadius * kStep * kRadians, 1e-5);
}

TEST(GroundStep, HasALengthOnAPoleAndWhereNoLatitudeIs) {
  Georeference degrees;
  degrees.crsWkt = "of longitude and latitude";
  degrees.isGeographic = true;
  const Vec2 equator = groundStep(degrees, -0.5, -0.5);
  EXPECT_NEAR(equator.x, 111319.49, 0.01);
  for (const double latitude : {90.0, -90.0, 95.0, 5e6, -1e9}) {
    const Vec2 step = groundStep(degrees, 7, latitude - 0.5);
    EXPECT_NEAR(step.x, equator.x, 1) << latitude;
    EXPECT_NEAR(step.y, equator.x, 1) << latitude;
  }
  EXPECT_LT(groundStep(degrees, 7, 88.5).x, 2000);
}

}  // namespace
}  // namespace arete
