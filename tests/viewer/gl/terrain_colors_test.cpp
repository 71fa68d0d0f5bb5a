// SPDX-License-Identifier: GPL-3.0-or-later
//
// Heights drawn in colours that are stated: level ground has exactly the colour of its height.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "terrain/builder/build.h"
#include "viewer/color_oracle.h"
#include "viewer/drawn_mesh.h"
#include "viewer/gl/frame_target.h"
#include "viewer/gl/terrain_drawable.h"

namespace arete {
namespace {

constexpr int kTerraces = 8, kWide = 12;  // samples of a terrace

/// Terraces from west to east, the k-th at height(k).
template <class Height>
TerrainModel terraced(const Height& height) {
  RasterHeightfield field;
  field.columns = kTerraces * kWide;
  field.rows = 40;
  for (std::uint32_t r = 0; r < field.rows; ++r)
    for (std::uint32_t c = 0; c < field.columns; ++c) field.heights.push_back(height(int(c) / kWide));
  field.georeference.geoTransform = {500000, 30, 0, 4000000, 0, -30};
  field.georeference.hasGeoTransform = true;
  Result<TerrainModel> model = build(field);
  EXPECT_TRUE(model);
  return std::move(*model);
}

/// The colours in the middle of each terrace, seen from above.
std::vector<std::vector<Rgb>> terracesOf(const TerrainModel& model, const ColorMap& heights, double highest) {
  constexpr int kAcross = 384, kDown = 160;
  Result<TerrainDrawable> drawn = TerrainDrawable::create(model, {});
  EXPECT_TRUE(drawn);
  TerrainColors colors;
  colors.heights = heights;
  ViewSettings settings;
  settings.look.isShaded = false;
  settings.look.colors = std::make_shared<const TerrainColors>(colors);
  const Vec2 middle = model.toSource({(kTerraces * kWide - 1) / 2.0, 19.5});
  const double away = 100000;  // nearly parallel
  const double across = kTerraces * kWide * 30.0, down = across * kDown / kAcross;
  const Camera camera{.xy = middle,
                      .height = highest + away,
                      .pitchDegrees = -90,
                      .verticalFieldOfViewDegrees = 2 * std::atan(down / 2 / away) * 180 / 3.141592653589793,
                      .widthPixels = kAcross,
                      .heightPixels = kDown};
  EXPECT_TRUE(drawn->cut(camera, settings));
  const auto target = FrameTarget::create(kAcross, kDown);
  target->begin();
  EXPECT_TRUE(drawn->draw(camera, settings));
  const Image image = target->image();
  std::vector<std::vector<Rgb>> seen(kTerraces);
  for (int k = 0; k < kTerraces; ++k)
    for (int x = k * 48 + 16; x < k * 48 + 32; ++x)
      for (int y = 30; y < 130; ++y) seen[std::size_t(k)].push_back(image.at(x, y));
  return seen;
}

TEST(TerrainColors, OfASeaAtExactlyItsLevelAreWaterEverywhere) {
  ARETE_NEEDS_OPENGL(context);
  for (const double level : {0.0, -411.7}) {
    const TerrainModel model =
        terraced([&](int k) { return k < 4 ? double(float(level)) : level + 123.4 * k; });
    const auto seen = terracesOf(model, heightColors(level, level + 900, level), level + 900);
    for (std::size_t k = 0; k < seen.size(); ++k)
      for (const Rgb& c : seen[k]) {
        if (k < 4) {
          ASSERT_EQ(c, colorTable("depth").at(1).opaque()) << "sea at " << level;
        } else {
          ASSERT_GT(labOf(c).b, 0) << "land has no blue, sea at " << level;
        }
      }
  }
}

TEST(TerrainColors, OfClassesEndAtExactlyTheirValues) {
  ARETE_NEEDS_OPENGL(context);
  for (const auto& [step, base] : {std::pair{500.0, 0.0}, {0.1, 2000.0}}) {
    std::vector<ColorStop> stops;
    for (int k = 0; k < kTerraces; ++k)
      stops.push_back({base + step * k, {std::uint8_t(20 + 30 * k), std::uint8_t(250 - 30 * k), 40}});
    const TerrainModel model = terraced([&](int k) { return double(float(base + step * k)); });
    for (const auto between : {ColorsBetween::discrete, ColorsBetween::exact}) {
      ColorMapOptions options;
      options.between = between;
      const auto seen = terracesOf(model, ColorMap::make(stops, options).value(), base + step * 8);
      for (std::size_t k = 0; k < seen.size(); ++k)
        for (const Rgb& c : seen[k])
          ASSERT_EQ(c, stops[k].color.opaque())
              << k << " of " << step << " from " << base << ", " << int(between);
    }
  }
}

TEST(TerrainColors, OfAnotherLookAreTakenWithTheNextPicture) {
  ARETE_NEEDS_OPENGL(context);
  const TerrainModel model = terraced([](int k) { return 10.0 * k; });
  const ColorMap red = ColorMap::make({{0, {255, 0, 0}}}).value(),
                 none = ColorMap::make({{0, {1, 2, 3, 0}}}).value();
  EXPECT_EQ(terracesOf(model, red, 70)[3][0], (Rgb{255, 0, 0}));
  EXPECT_EQ(terracesOf(model, none, 70)[3][0], (Rgb{199, 199, 199})) << "plain ground";
}

}  // namespace
}  // namespace arete
