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

/// Finds the values that a map's colours stand for.
class ValuesOfColors {
 public:
  ValuesOfColors(const ColorMap& map, double low, double high) : low_(low), high_(high) {
    for (int i = 0; i <= kSteps; ++i) colors_.push_back(map.at(low + (high - low) * i / kSteps));
  }
  double of(Rgb color) const {
    int best = 0, least = 1 << 30;
    for (int i = 0; i <= kSteps; ++i) {
      const Rgba& c = colors_[std::size_t(i)];
      const int r = c.r - color.r, g = c.g - color.g, b = c.b - color.b, off = r * r + g * g + b * b;
      if (off < least) least = off, best = i;
    }
    return low_ + (high_ - low_) * best / kSteps;
  }

 private:
  static constexpr int kSteps = 720;
  double low_, high_;
  std::vector<Rgba> colors_;
};

TerrainModel modelFrom(const auto& height, std::uint32_t side, double step) {
  RasterHeightfield field;
  field.columns = field.rows = side;
  field.georeference.geoTransform = {0, step, 0, 0, 0, -step};
  field.georeference.hasGeoTransform = true;
  for (std::uint32_t row = 0; row < side; ++row)
    for (std::uint32_t column = 0; column < side; ++column)
      field.heights.push_back(height(column * step, -double(row) * step));
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
      200, 10);
  auto view = TerrainDrawable::create(model, {});
  ASSERT_TRUE(view);
  double sum = 0;
  const HeightPyramid pyramid = *HeightPyramid::create(model);
  for (const HeightPyramid::Ground& g : pyramid.levels()[0].ground) sum += 90.0 * g.slope / g.covered;
  const double expected = sum / double(pyramid.levels()[0].ground.size());
  const ValuesOfColors slopes(colorTable("slope"), 0, 60);
  for (const int pixels : {25, 100, 300}) {
    const Image image = fromAbove(*view, model, Coloring::slope, pixels);
    double total = 0;
    int count = 0;
    const int stride = std::max(1, pixels / 50);
    for (int y = pixels / 10; y < pixels - pixels / 10; y += stride)
      for (int x = pixels / 10; x < pixels - pixels / 10; x += stride) {
        total += slopes.of(image.at(x, y));
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
      200, 10);
  auto view = TerrainDrawable::create(model, {});
  ASSERT_TRUE(view);
  const HeightPyramid pyramid = *HeightPyramid::create(model);
  double east = 0, north = 0;
  for (const HeightPyramid::Ground& g : pyramid.levels()[0].ground) east += g.east, north += g.north;
  const double expected = std::atan2(east, north) / kTurn * 360;
  ASSERT_GT(std::hypot(east, north) / HeightPyramid::kOne / double(pyramid.levels()[0].ground.size()), 0.2);
  const ValuesOfColors aspects(colorTable("aspect"), 0, 360);
  for (const int pixels : {10, 20}) {
    const Image image = fromAbove(*view, model, Coloring::aspect, pixels);
    Vec2 sum;
    for (int y = pixels / 5; y < pixels - pixels / 5; ++y)
      for (int x = pixels / 5; x < pixels - pixels / 5; ++x) {
        const double got = aspects.of(image.at(x, y));
        sum.x += std::sin(got * kTurn / 360);
        sum.y += std::cos(got * kTurn / 360);
      }
    EXPECT_LT(std::abs(std::remainder(std::atan2(sum.x, sum.y) * 360 / kTurn - expected, 360)), 2) << pixels;
  }
}

TEST(Ground, AspectsThatCancelHaveTheColourOfNone) {
  ARETE_NEEDS_OPENGL(context);
  const TerrainModel model =
      modelFrom([](double x, double) { return 30 * std::sin(x * kTurn / 40); }, 160, 10);
  auto view = TerrainDrawable::create(model, {});
  ASSERT_TRUE(view);
  const Image image = fromAbove(*view, model, Coloring::aspect, 10);
  for (int y = 2; y < 8; ++y)
    for (int x = 2; x < 8; ++x) {
      const Rgb c = image.at(x, y);
      EXPECT_LE(std::max({std::abs(c.r - kNoAspectColor.r), std::abs(c.g - kNoAspectColor.g),
                          std::abs(c.b - kNoAspectColor.b)}),
                3);
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
  const TerrainModel model =
      modelFrom([](double x, double y) { return 80 * std::sin(x / 90) * std::cos(y / 70); }, 150, 10);
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
