// SPDX-License-Identifier: GPL-3.0-or-later
//
// Heights, slopes and aspects that pictures show, read back from their colours.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "terrain/builder/build.h"
#include "viewer/color/color_tables.h"
#include "viewer/drawn_mesh.h"
#include "viewer/gl/frame_target.h"
#include "viewer/gl/terrain_drawable.h"

namespace arete {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

/// The value of a map's colour nearest to one.
double valueOf(const ColorMap& map, Rgb color, double low, double high) {
  double best = 0, least = INFINITY;
  for (int i = 0; i <= 3600; ++i) {
    const double value = low + (high - low) * i / 3600;
    const Rgba c = map.at(value);
    const double off = std::pow(c.r - color.r, 2) + std::pow(c.g - color.g, 2) + std::pow(c.b - color.b, 2);
    if (off < least) least = off, best = value;
  }
  return best;
}

TerrainModel modelFrom(const auto& height, std::uint32_t side, double step) {
  RasterHeightfield field;
  field.columns = field.rows = side;
  field.georeference.geoTransform = {0, step, 0, 0, 0, -step};
  field.georeference.hasGeoTransform = true;
  for (std::uint32_t row = 0; row < side; ++row)
    for (std::uint32_t column = 0; column < side; ++column) field.heights.push_back(height(column * step, -double(row) * step));
  auto model = build(field);
  EXPECT_TRUE(model);
  return std::move(*model);
}

/// From far above, so that the ground fills the middle of the picture.
Image fromAbove(TerrainDrawable& view, const TerrainModel& model, Coloring coloring, int pixels) {
  const Vec2 middle = model.toSource({model.columns / 2.0, model.rows / 2.0});
  const double extent = model.columns * model.mt.metric().scale.x;
  Camera camera{.xy = middle,
                .height = 20 * extent,
                .pitchDegrees = -90,
                .verticalFieldOfViewDegrees = 2.6,
                .widthPixels = double(pixels),
                .heightPixels = double(pixels)};
  ViewSettings settings;
  settings.look.isShaded = false;
  settings.look.coloring = coloring;
  EXPECT_TRUE(view.cut(camera, settings));
  const auto target = FrameTarget::create(pixels, pixels);
  EXPECT_TRUE(target);
  target->begin();
  EXPECT_TRUE(view.draw(camera, settings));
  return target->image();
}

// Ridges two samples wide on a hillside: their gradients cancel in small pictures, their angles do not.
TEST(Ground, TheMeanSlopeIsTheSameInPicturesOfAnySize) {
  ARETE_NEEDS_OPENGL(context);
  const TerrainModel model = modelFrom(
      [](double x, double y) {
        return 0.2 * x + 40 * std::sin(x / 35) * std::cos(y / 55) + 3 * std::sin(x / 5.1) * std::cos(y / 6.3);
      },
      360, 10);
  auto view = TerrainDrawable::create(model, {});
  ASSERT_TRUE(view);
  double sum = 0;
  const HeightPyramid pyramid = *HeightPyramid::create(model);
  for (const HeightPyramid::Ground& g : pyramid.levels()[0].ground) sum += 90.0 * g.slope / g.covered;
  const double expected = sum / double(pyramid.levels()[0].ground.size());
  for (const int pixels : {40, 100, 300, 700}) {
    const Image image = fromAbove(*view, model, Coloring::slope, pixels);
    double total = 0;
    int count = 0;
    const int stride = std::max(1, pixels / 100);
    for (int y = pixels / 10; y < pixels - pixels / 10; y += stride)
      for (int x = pixels / 10; x < pixels - pixels / 10; x += stride) {
        total += valueOf(colorTable("slope"), image.at(x, y), 0, 60);
        ++count;
      }
    EXPECT_NEAR(total / count, expected, 0.02 * expected) << pixels << " pixels";
  }
}

TEST(Ground, AspectIsTheCircularMeanOfDirections) {
  ARETE_NEEDS_OPENGL(context);
  // Roofs: half of the ground falls to the west (270), half to azimuth 330.
  const double azimuth = 330 * kTurn / 360;
  const TerrainModel model = modelFrom(
      [&](double x, double y) {
        // Along the line on which both planes are equally high, stripes alternate.
        const double west = 0.5 * x, other = -0.5 * (std::sin(azimuth) * x + std::cos(azimuth) * y);
        const double across = west - other, period = 60;
        const double folded = std::abs(std::remainder(across, period));
        return other + across / 2 + (folded - period / 4) * 1.0;
      },
      400, 10);
  auto view = TerrainDrawable::create(model, {});
  ASSERT_TRUE(view);
  const HeightPyramid pyramid = *HeightPyramid::create(model);
  double east = 0, north = 0;
  for (const HeightPyramid::Ground& g : pyramid.levels()[0].ground) east += g.east, north += g.north;
  const double expected = std::atan2(east, north) / kTurn * 360;
  ASSERT_GT(std::hypot(east, north) / HeightPyramid::kOne / double(pyramid.levels()[0].ground.size()), 0.2);
  const Image image = fromAbove(*view, model, Coloring::aspect, 20);
  for (int y = 4; y < 16; ++y)
    for (int x = 4; x < 16; ++x) {
      const double got = valueOf(colorTable("aspect"), image.at(x, y), 0, 360);
      EXPECT_LT(std::abs(std::remainder(got - expected, 360)), 2.5) << x << ", " << y;
    }
}

TEST(Ground, AspectsThatCancelHaveTheColourOfNone) {
  ARETE_NEEDS_OPENGL(context);
  const TerrainModel model =
      modelFrom([](double x, double) { return 30 * std::sin(x * kTurn / 60); }, 400, 10);
  auto view = TerrainDrawable::create(model, {});
  ASSERT_TRUE(view);
  const Image image = fromAbove(*view, model, Coloring::aspect, 20);
  for (int y = 4; y < 16; ++y)
    for (int x = 4; x < 16; ++x) {
      const Rgb c = image.at(x, y);
      EXPECT_LE(std::max({std::abs(c.r - kNoAspectColor.r), std::abs(c.g - kNoAspectColor.g), std::abs(c.b - kNoAspectColor.b)}), 3);
    }
}

TEST(Ground, LevelsThatDoNotFitAreLeftOutWithAWord) {
  ARETE_NEEDS_OPENGL(context);
  const TerrainModel model = modelFrom([](double x, double y) { return 0.3 * x - 0.1 * y; }, 300, 10);
  const HeightPyramid pyramid = *HeightPyramid::create(model);
  const auto whole = HeightsOnGpu::load(pyramid);
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->finestLevel(), 0);
  EXPECT_TRUE(whole->warnings().empty());
  const auto half = HeightsOnGpu::load(pyramid, {.mostBytes = whole->bytes() / 2});
  ASSERT_TRUE(half);
  EXPECT_GT(half->finestLevel(), 0);
  EXPECT_LE(half->bytes(), whole->bytes() / 2);
  ASSERT_EQ(half->warnings().size(), 1u);
  EXPECT_FALSE(HeightsOnGpu::load(pyramid, {.mostBytes = 100}));
}

// The same picture through tiles of any size: no seam between them.
TEST(Ground, TilesHaveNoSeams) {
  ARETE_NEEDS_OPENGL(context);
  const TerrainModel model = modelFrom([](double x, double y) { return 80 * std::sin(x / 90) * std::cos(y / 70); }, 150, 10);
  std::vector<Image> images;
  for (const std::uint32_t side : {5u, 64u, 512u}) {
    auto view = TerrainDrawable::create(model, {.heights = {.tileSide = side}});
    ASSERT_TRUE(view) << view.error().describe();
    images.push_back(fromAbove(*view, model, Coloring::height, 200));
  }
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x) {
      EXPECT_EQ(images[0].at(x, y), images[2].at(x, y)) << x << ", " << y;
      EXPECT_EQ(images[1].at(x, y), images[2].at(x, y)) << x << ", " << y;
    }
}

}  // namespace
}  // namespace arete
