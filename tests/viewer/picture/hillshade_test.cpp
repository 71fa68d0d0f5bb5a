// SPDX-License-Identifier: GPL-3.0-or-later
// Shaded relief over ground whose light is known.
#include "viewer/picture/hillshade.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

#include "viewer/color/color_tables.h"
#include "viewer/picture/map_view.h"
#include "viewer/picture_fixture.h"

namespace arete {
namespace {

using test::field;
using test::kNone;
using test::located;

TEST(Hillshade, IsUniformOnFlatGround) {
  const auto h = located(field(40, 30, [](double, double) { return 250.0; }), 30);
  const Image image = drawHillshade(h, fitGrid(40, 30, h.georeference, 117, 117));
  for (const Rgb& pixel : image.pixels) ASSERT_EQ(pixel, image.at(0, 0));
}

TEST(Hillshade, LightsTheUpperLeftOfAHill) {
  const auto h =
      located(field(41, 41, [](double c, double r) { return 400 - 14 * std::hypot(c - 20, r - 20); }), 30);
  const Image image = drawHillshade(h, fitGrid(41, 41, h.georeference, 200, 200), {.tint = 0});
  EXPECT_GT(image.at(70, 70).g, image.at(130, 130).g + 40);
  const auto southUp = located(h, 30, true);
  const Image turned = drawHillshade(southUp, fitGrid(41, 41, southUp.georeference, 200, 200), {.tint = 0});
  EXPECT_EQ(turned.at(70, 70), image.at(70, 70)) << "a hill is its own mirror image, and the light stays put";
}

TEST(Hillshade, LeavesNodataAlone) {
  const auto h = located(field(40, 40, [](double c, double) { return c < 20 ? kNone : 5.0; }), 30);
  const Image image = drawHillshade(h, fitGrid(40, 40, h.georeference, 80, 80));
  EXPECT_EQ(image.at(5, 40), kNodataColor);
  EXPECT_NE(image.at(75, 40), kNodataColor);
  const Image none =
      drawHillshade(located(field(4, 4, [](double, double) { return kNone; }), 1), fitGrid(4, 4, {}, 20, 20));
  for (const Rgb& pixel : none.pixels) ASSERT_EQ(pixel, kNodataColor);
}

TEST(Hillshade, HasNoFringeBetweenDataAndNodataAtAnySize) {
  const auto h = located(
      field(300, 200, [](double c, double r) { return std::hypot(c - 150, r - 100) > 70 ? kNone : 1200.0; }),
      30);
  const Rgb ground = heightColors(1200, 1200).at(1200).opaque();
  for (const int size : {7, 23, 60, 150, 299, 640}) {
    const MapView view = fitGrid(300, 200, h.georeference, size, size);
    const Image image = drawHillshade(h, view);
    std::size_t data = 0;
    for (const Rgb& pixel : image.pixels) {
      ASSERT_TRUE(pixel == ground || pixel == kNodataColor) << "at " << size;
      data += pixel == ground ? 1 : 0;
    }
    const double share = 3.14159 * 70 * 70 / (299.0 * 199.0);
    EXPECT_NEAR(double(data) / double(image.pixels.size()), share, 0.5 / size + 0.01) << "at " << size;
  }
}

TEST(Hillshade, KeepsTheTintOfLevelGroundAndClipsNoCliff) {
  // A plain, and a wall of 60 m that faces the light.
  const auto h = located(field(60, 60,
                               [](double c, double r) {
                                 return c + r > 60 ? 60.0 : c + r < 58 ? 0.0 : 30 * (c + r - 58);
                               }),
                         1);
  const Image image =
      drawHillshade(h, fitGrid(60, 60, h.georeference, 120, 120), {.verticalExaggeration = 1});
  EXPECT_EQ(image.at(10, 10), heightColors(0, 60).at(0).opaque());
  EXPECT_EQ(image.at(110, 110), heightColors(0, 60).at(60).opaque());
  int brightest = 0;
  for (const Rgb& pixel : image.pixels)
    brightest = std::max({brightest, int(pixel.r), int(pixel.g), int(pixel.b)});
  EXPECT_LT(brightest, 255);
  // White paper stays below white, too.
  const Image paper = drawHillshade(h, fitGrid(60, 60, h.georeference, 120, 120), {.tint = 0});
  for (const Rgb& pixel : paper.pixels) EXPECT_LT(pixel.r, 255);
}

TEST(Hillshade, AveragesAllSamplesWhenReduced) {
  // A fine checkerboard of 10 m around a level of 100 m is level when its samples are far smaller than a
  // pixel.
  const auto h = located(
      field(801, 801, [](std::uint32_t c, std::uint32_t r) { return (c + r) % 2 == 0 ? 90.0 : 110.0; }), 1);
  const Image image =
      drawHillshade(h, fitGrid(801, 801, h.georeference, 40, 40), {.verticalExaggeration = 1});
  for (int y = 2; y < 38; ++y) {
    for (int x = 2; x < 38; ++x) ASSERT_NEAR(image.at(x, y).g, image.at(20, 20).g, 2);
  }
}

}  // namespace
}  // namespace arete
