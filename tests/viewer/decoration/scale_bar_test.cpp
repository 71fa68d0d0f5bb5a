// SPDX-License-Identifier: GPL-3.0-or-later
// The lengths of the bar against closed formulas of the maps.
#include "viewer/decoration/scale_bar.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "viewer/decoration_fixture.h"

namespace arete {
namespace {

using namespace test;

constexpr double kA = 6378137, kE2 = 0.0066943799901413165;

/// Metres along the parallel for one radian of longitude.
double alongParallel(double latitudeDegrees) {
  const double phi = latitudeDegrees * std::numbers::pi / 180;
  return kA * std::cos(phi) / std::sqrt(1 - kE2 * std::sin(phi) * std::sin(phi));
}

double metresPerPixel(const PictureGround& ground) {
  const auto bar = scaleBarOf(ground, 200);
  return bar ? bar->length / bar->pixels : 0;
}

TEST(ScaleBar, IsOfGroundMetresInWebMercator) {
  for (const double latitude : {0.0, 34.0, 60.0, 75.0, -45.0}) {
    const double y = kA * std::log(std::tan(std::numbers::pi / 4 + latitude * std::numbers::pi / 360));
    const PictureGround ground = pictureOf(mapAbout("EPSG:3857", {1e6, y}, 30));
    const double mapMetres = 30 * 100 / ground.frame().width;
    EXPECT_NEAR(metresPerPixel(ground), mapMetres * alongParallel(latitude) / kA, 2e-4 * mapMetres)
        << latitude;
  }
}

TEST(ScaleBar, IsOfGroundMetresInDegreesAndInFeet) {
  const PictureGround degrees = pictureOf(degreesAbout({15, 60}, 0.001));
  const double perPixel = 0.1 / degrees.frame().width * std::numbers::pi / 180;
  EXPECT_NEAR(metresPerPixel(degrees), perPixel * alongParallel(60), 1e-4 * perPixel * kA);

  // UTM has the scale 0.9996 on its central meridian.
  const PictureGround utm = pictureOf(mapAbout("EPSG:32633", {500000, 5000000}, 30));
  EXPECT_NEAR(metresPerPixel(utm), 30 * 100 / utm.frame().width / 0.9996, 1e-5);

  Georeference feet = mapAbout("EPSG:2227", {6000000, 2100000}, 100);
  feet.linearUnitMetres = 1200.0 / 3937;
  const PictureGround inFeet = pictureOf(feet);
  EXPECT_NEAR(metresPerPixel(inFeet), 100 * 100 / inFeet.frame().width * 0.3048006096, 1e-3);
}

TEST(ScaleBar, HasARoundLengthThatFits) {
  for (const double cell : {1e-4, 0.01, 0.7, 3.0, 90.0, 4000.0}) {
    Georeference plain = mapAbout("", {0, 0}, cell);
    const auto bar = scaleBarOf(pictureOf(plain), 200);
    ASSERT_TRUE(bar);
    EXPECT_LE(bar->pixels, 200.001);
    EXPECT_GE(bar->pixels, 79.999);
    const double mantissa = bar->length / std::pow(10, std::floor(std::log10(bar->length) + 1e-9));
    EXPECT_TRUE(std::abs(mantissa - 1) < 1e-6 || std::abs(mantissa - 2) < 1e-6 ||
                std::abs(mantissa - 5) < 1e-6)
        << bar->length;
    EXPECT_NE(bar->label.find("units"), std::string::npos) << "without a CRS no metres are claimed";
    EXPECT_EQ(bar->where, "");
  }
}

TEST(ScaleBar, SaysWhereItHoldsOnAMapOfManyScales) {
  EXPECT_EQ(scaleBarOf(pictureOf(degreesAbout({0, 0}, 0.01)), 200)->where, "");
  EXPECT_EQ(scaleBarOf(pictureOf(degreesAbout({0, 40}, 0.6)), 200)->where, "at the middle");
  EXPECT_EQ(scaleBarOf(pictureOf(mapAbout("EPSG:3857", {0, 0}, 150000)), 200)->where, "at the middle");
}

TEST(ScaleBar, OfAViewSaysWhereItHolds) {
  const auto middle = scaleBarOf(obliqueView("", -30), 200);
  ASSERT_TRUE(middle);
  EXPECT_EQ(middle->where, "at the middle");
  EXPECT_FALSE(middle->cross);
  // 30 degrees down from 100 up is 200 away; a pixel is 1/500 of that.
  EXPECT_NEAR(middle->length / middle->pixels, 200.0 / 500, 1e-9);
  // The middle is sky: the bar holds at the ground nearest below it, and a cross shows where.
  const auto low = scaleBarOf(obliqueView("", 10), 200);
  ASSERT_TRUE(low);
  EXPECT_EQ(low->where, "at the cross");
  ASSERT_TRUE(low->cross);
  EXPECT_GT(low->cross->y, 300);
  EXPECT_FALSE(scaleBarOf(obliqueView("", 80), 200)) << "no ground, no scale";
}

TEST(ScaleBar, WritesLengthsForPeople) {
  EXPECT_EQ(lengthText(1000, true, ""), "1 km");
  EXPECT_EQ(lengthText(500, true, ""), "500 m");
  EXPECT_EQ(lengthText(0.5, true, ""), "50 cm");
  EXPECT_EQ(lengthText(0.01, true, ""), "1 cm");
  EXPECT_EQ(lengthText(0.002, true, ""), "2 mm");
  EXPECT_EQ(lengthText(5, false, "units"), "5 units");
  EXPECT_EQ(lengthText(5, false, ""), "5");
}

}  // namespace
}  // namespace arete
