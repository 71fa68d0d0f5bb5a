// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/decoration/decorations.h"

#include <gtest/gtest.h>

#include "viewer/color/color_tables.h"
#include "viewer/decoration_fixture.h"
#include "viewer/picture_fixture.h"

namespace arete {
namespace {

using namespace test;

constexpr Rgb kGround = {120, 140, 100};

PictureGround frameOf(int width, int height) {
  Georeference g = mapAbout("EPSG:32633", {500000, 5000000}, 30);
  MapView view;
  view.width = width;
  view.height = height;
  view.columnsPerPixel = view.rowsPerPixel = 0.2;
  return PictureGround::ofMap(view, g, {0, 0});
}

int changed(const Canvas& canvas) {
  int count = 0;
  for (int y = 0; y < canvas.height(); ++y)
    for (int x = 0; x < canvas.width(); ++x) count += canvas.pixel(x, y) == kGround ? 0 : 1;
  return count;
}

TEST(Decorations, AreDrawnOneByOne) {
  const ColorLegend legend = legendOf(colorTable("height").over(4321.2, 4321.8), "height", "m");
  const auto drawn = [&](Decorations which) {
    Canvas canvas = *Canvas::create(800, 500, kGround);
    decorate(canvas, frameOf(800, 500), std::span(&legend, 1), which);
    return changed(canvas);
  };
  const Decorations none = Decorations::none();
  EXPECT_FALSE(none.any());
  EXPECT_EQ(drawn(none), 0);
  for (bool Decorations::*part :
       {&Decorations::legend, &Decorations::scaleBar, &Decorations::north, &Decorations::graticule}) {
    Decorations one = none;
    one.*part = true;
    EXPECT_GT(drawn(one), 500);
    EXPECT_LT(drawn(one), drawn({}));
  }
}

TEST(Decorations, LeaveRoomInPicturesOfAnySize) {
  const ColorLegend legend = legendOf(colorTable("height").over(0, 3000), "height", "m");
  for (const auto& [width, height] :
       {std::pair{1, 1}, {3, 200}, {200, 3}, {64, 64}, {160, 120}, {480, 270}, {1920, 1080}, {300, 2000}}) {
    Canvas canvas = *Canvas::create(width, height, kGround);
    decorate(canvas, frameOf(width, height), std::span(&legend, 1));
    EXPECT_LE(changed(canvas), width * height * 0.6) << width << " x " << height;
  }
}

TEST(Decorations, MayBeDrawnOnNothingAndLaidOverAPicture) {
  const ColorLegend legend = legendOf(colorTable("height").over(0, 3000), "height", "m");
  Canvas clear = *Canvas::createClear(640, 480), opaque = *Canvas::create(640, 480, kGround);
  decorate(clear, frameOf(640, 480), std::span(&legend, 1));
  decorate(opaque, frameOf(640, 480), std::span(&legend, 1));
  const auto bytes = clear.premultipliedRgba();
  ASSERT_EQ(bytes.size(), 640u * 480 * 4);
  for (int y = 0; y < 480; ++y)
    for (int x = 0; x < 640; ++x) {
      const std::size_t i = (std::size_t(y) * 640 + std::size_t(x)) * 4;
      const auto over = [&](std::size_t c, std::uint8_t below) {
        return bytes[i + c] + below * (255 - bytes[i + 3]) / 255.0;
      };
      const Rgb expected = opaque.pixel(x, y);
      ASSERT_NEAR(over(0, kGround.r), expected.r, 3) << x << " " << y;
      ASSERT_NEAR(over(1, kGround.g), expected.g, 3) << x << " " << y;
      ASSERT_NEAR(over(2, kGround.b), expected.b, 3) << x << " " << y;
    }
  EXPECT_EQ(clear.picture().pixels.size(), 640u * 480);
}

}  // namespace
}  // namespace arete
