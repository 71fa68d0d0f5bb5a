// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/decoration/picture_ground.h"

#include <gtest/gtest.h>

#include <GeographicLib/UTMUPS.hpp>
#include <cmath>

#include "viewer/decoration_fixture.h"

namespace arete {
namespace {

using namespace test;

TEST(PictureGround, LeadsFromPixelsToPlacesAndBack) {
  const PictureGround ground = pictureOf(mapAbout("EPSG:32633", {400000, 6500000}, 25));
  for (const Vec2 pixel : {Vec2{30, 20}, {430, 420}, {829, 819}, {100.25, 700.75}}) {
    const auto place = ground.lonLatAt(pixel);
    ASSERT_TRUE(place);
    int zone = 0;
    bool isNorth = true;
    double x = 0, y = 0;
    GeographicLib::UTMUPS::Forward(place->y, place->x, zone, isNorth, x, y, 33);
    const auto source = ground.sourceAt(pixel);
    EXPECT_NEAR(x, source->x, 1e-3);
    EXPECT_NEAR(y, source->y, 1e-3);
    const auto back = ground.pixelOf(*place);
    ASSERT_TRUE(back);
    EXPECT_NEAR(back->x, pixel.x, 1e-6);
    EXPECT_NEAR(back->y, pixel.y, 1e-6);
  }
}

TEST(PictureGround, CountsLongitudesFromGreenwich) {
  // The grid of Paris: its central meridian is 2 degrees 20 minutes 14.025 seconds east.
  Georeference paris = mapAbout("EPSG:27572", {600000, 2428000}, 10);
  paris.semiMajorAxisMetres = 6378249.2;
  paris.inverseFlattening = 293.4660212936265;
  const PictureGround ground = pictureOf(paris);
  const auto place = ground.lonLatAt(middleOf(ground));
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->x, 2 + 20.0 / 60 + 14.025 / 3600, 1e-5);
  EXPECT_NEAR(place->y, 48.85, 0.02);
  const auto back = ground.pixelOf(*place);
  ASSERT_TRUE(back);
  EXPECT_NEAR(back->x, middleOf(ground).x, 1e-6);
  EXPECT_NEAR(ground.northAt(middleOf(ground))->convergenceDegrees, 0, 1e-3);
}

TEST(PictureGround, KnowsNoPlacesWithoutACrs) {
  const PictureGround ground = pictureOf(mapAbout("", {0, 0}, 2));
  EXPECT_FALSE(ground.hasCrs());
  EXPECT_FALSE(ground.hasLonLat());
  EXPECT_FALSE(ground.lonLatAt(middleOf(ground)));
  EXPECT_FALSE(ground.pixelOf({0, 0}));
  EXPECT_NEAR(*ground.lengthPerPixel(middleOf(ground)), 200.0 / 800, 1e-9);
}

TEST(PictureGround, HasNoPlaceBeyondThePole) {
  const PictureGround ground = pictureOf(degreesAbout({0, 89.99}, 0.001));
  EXPECT_FALSE(ground.lonLatAt({430, 21})) << "90.03 degrees of latitude";
  EXPECT_TRUE(ground.lonLatAt({430, 800}));
}

}  // namespace
}  // namespace arete
