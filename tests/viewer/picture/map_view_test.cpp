// SPDX-License-Identifier: GPL-3.0-or-later
// Which part of a grid is seen in which pixels.
#include "viewer/picture/map_view.h"

#include <gtest/gtest.h>
#include <cmath>

#include "viewer/picture_fixture.h"

namespace arete {
namespace {

using test::field;
using test::located;

TEST(MapView, KeepsTheGroundsAspect) {
  // At 60 degrees a degree of longitude is about half a degree of latitude.
  RasterHeightfield h = field(101, 101, [](double, double) { return 0.0; });
  h.georeference.crsWkt = "GEOGCS";
  h.georeference.isGeographic = true;
  h.georeference.hasGeoTransform = true;
  h.georeference.geoTransform = {10, 0.001, 0, 60.05, 0, -0.001};
  const MapView view = fitGrid(101, 101, h.georeference, 1000, 1000);
  EXPECT_EQ(view.height, 1000);
  EXPECT_NEAR(view.width, 501, 3);
}

TEST(MapView, TurnsASouthUpGridOver) {
  const auto h = located(field(11, 6, [](double, double) { return 0.0; }), 10, true);
  const MapView view = fitGrid(11, 6, h.georeference, 100, 100);
  EXPECT_EQ(view.toPixel(0, 5).y, 0);
  EXPECT_EQ(view.toPixel(0, 0).y, view.height);
}

}  // namespace
}  // namespace arete
