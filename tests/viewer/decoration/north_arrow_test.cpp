// SPDX-License-Identifier: GPL-3.0-or-later
// Directions against GeographicLib's own projections, which share no code with PROJ.
#include "viewer/decoration/north_arrow.h"

#include <gtest/gtest.h>

#include <GeographicLib/UTMUPS.hpp>
#include <cmath>
#include <numbers>

#include "viewer/decoration_fixture.h"

namespace arete {
namespace {

using namespace test;

double degreesClockwiseFromUp(Vec2 v) {
  return std::atan2(v.x, -v.y) * 180 / std::numbers::pi;
}

TEST(NorthArrow, PointsToTrueNorthAndSaysHowTheGridIsTurned) {
  for (const double latitude : {-70.0, -33.0, 0.5, 34.0, 60.0, 80.0})
    for (const double longitude : {12.2, 15.0, 17.8}) {
      int zone = 0;
      bool isNorth = true;
      double x = 0, y = 0, gamma = 0, scale = 0;
      GeographicLib::UTMUPS::Forward(latitude, longitude, zone, isNorth, x, y, gamma, scale, 33);
      const PictureGround ground = pictureOf(mapAbout(isNorth ? "EPSG:32633" : "EPSG:32733", {x, y}, 30));
      const auto north = ground.northAt(middleOf(ground));
      ASSERT_TRUE(north);
      EXPECT_TRUE(north->isTrue);
      EXPECT_NEAR(north->convergenceDegrees, gamma, 0.01) << latitude << ", " << longitude;
      EXPECT_NEAR(degreesClockwiseFromUp(north->toNorth), -gamma, 0.01);
      const auto arrow = northArrowOf(ground);
      ASSERT_TRUE(arrow);
      EXPECT_EQ(arrow->words.front(), "true north");
      const bool isTurned = arrow->words.back().starts_with("grid north");
      EXPECT_EQ(isTurned, std::abs(gamma) >= 0.05) << gamma;
      if (isTurned) {
        EXPECT_NE(arrow->words.back().find(gamma > 0 ? "east of it" : "west of it"), std::string::npos);
      }
    }
}

TEST(NorthArrow, IsUpWhereTheMapIsOfDegrees) {
  for (const Vec2 middle : {Vec2{0, 0}, {190, 45}, {-179.99, -60}, {10, 89}}) {
    const auto arrow = northArrowOf(pictureOf(degreesAbout(middle, 0.001)));
    ASSERT_TRUE(arrow);
    EXPECT_EQ(arrow->words, std::vector<std::string>{"true north"});
    EXPECT_NEAR(degreesClockwiseFromUp(arrow->toNorth), 0, 0.01);
  }
}

TEST(NorthArrow, TurnsWithThePoleInTheMap) {
  // Polar stereographic, the meridian of 45 degrees west runs down from the pole.
  for (int turn = 0; turn < 8; ++turn) {
    const double angle = turn * std::numbers::pi / 4;
    const Vec2 place = {1e6 * std::sin(angle), 1e6 * std::cos(angle)};
    const PictureGround ground = pictureOf(mapAbout("EPSG:3413", place, 30));
    const auto north = ground.northAt(middleOf(ground));
    ASSERT_TRUE(north);
    EXPECT_TRUE(north->isTrue);
    // To the origin of the map, which is the pole.
    EXPECT_NEAR(north->toNorth.x, -std::sin(angle), 1e-3);
    EXPECT_NEAR(north->toNorth.y, std::cos(angle), 1e-3);
  }
  const auto atPole = northArrowOf(pictureOf(mapAbout("EPSG:3413", {0, 0}, 30000)));
  ASSERT_TRUE(atPole);
  EXPECT_EQ(atPole->words, std::vector<std::string>{"grid north"}) << "at the pole every direction is south";
  const auto around = northArrowOf(pictureOf(mapAbout("EPSG:3413", {400000, 0}, 30000)));
  ASSERT_TRUE(around);
  EXPECT_EQ(around->words[1], "at the middle") << "north turns over the picture";
}

TEST(NorthArrow, ClaimsNothingThatIsNotKnown) {
  EXPECT_FALSE(northArrowOf(pictureOf(mapAbout("", {0, 0}, 30)))) << "no CRS, no north";
  const auto site = northArrowOf(pictureOf(mapAbout("LOCAL_CS[\"site\",UNIT[\"metre\",1]]", {0, 0}, 30)));
  ASSERT_TRUE(site);
  EXPECT_EQ(site->words, std::vector<std::string>{"grid north"});
}

TEST(NorthArrow, LeadsIntoAViewThatLooksNorth) {
  const auto arrow = northArrowOf(obliqueView("EPSG:32633", -30));
  ASSERT_TRUE(arrow);
  EXPECT_EQ(arrow->words.front(), "true north");
  EXPECT_NEAR(arrow->toNorth.y, -1, 1e-3);
}

}  // namespace
}  // namespace arete
