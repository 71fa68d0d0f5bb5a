// SPDX-License-Identifier: GPL-3.0-or-later
//
// The oracle: whether the middle of a pixel is in an odd number of rings, by a ray.
#include "viewer/layers/polygon_fill.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "datasets/random.h"
#include "terrain/builder/build.h"
#include "viewer/headless/headless.h"

namespace arete {
namespace {

TerrainModel plain() {
  RasterHeightfield field;
  field.columns = 21;
  field.rows = 11;
  field.heights.assign(231, 5);
  field.georeference.geoTransform = {1000, 10, 0, 2000, 0, -10};
  field.georeference.hasGeoTransform = true;
  Result<TerrainModel> model = build(field);
  EXPECT_TRUE(model);
  return std::move(*model);
}

bool isIn(const FeatureLayer& layer, Vec2 p) {
  bool in = false;
  for (const auto& line : layer.lines)
    for (std::uint64_t i = line.first + 1; i < line.first + line.count; ++i) {
      const Vec2 a = layer.vertices[i - 1], b = layer.vertices[i];
      if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) in = !in;
    }
  return in;
}

TEST(PolygonFill, CoversAPolygonButItsHole) {
  const TerrainModel model = plain();
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Random random(seed);
    FeatureLayer layer;
    for (const double radius : {70.0, 25.0}) {
      layer.lines.push_back({layer.vertices.size(), 17, 0});
      for (int i = 0; i <= 16; ++i) {
        const double angle = (i % 16) * 0.3926990816987241;
        const double r = i == 16 ? 0 : radius * random.between(0.7, 1.0);
        layer.vertices.push_back(i == 16 ? layer.vertices[layer.lines.back().first]
                                         : Vec2{1105 + r * std::cos(angle), 1950 + r * std::sin(angle)});
      }
    }
    const auto fill = fillOf(layer, model, {10, 20, 30}, 200);
    ASSERT_TRUE(fill);
    int wrong = 0, inside = 0;
    for (int row = 0; row < fill->height; ++row)
      for (int column = 0; column < fill->width; ++column) {
        const Rgba pixel = fill->rgba[std::size_t(row * fill->width + column)];
        const Vec2 plan{((column + 0.5) / fill->width - fill->shift.x) / fill->scale.x,
                        ((row + 0.5) / fill->height - fill->shift.y) / fill->scale.y};
        const Vec2 xy = model.toSource(plan);
        const bool isMargin = column == 0 || row == 0 || column + 1 == fill->width || row + 1 == fill->height;
        if (pixel[3] == 255) {
          ++inside;
          wrong += isIn(layer, xy) ? 0 : 1;
        } else if (pixel[3] == 0 && !isMargin) {
          wrong += isIn(layer, xy) ? 1 : 0;
        }
      }
    EXPECT_EQ(wrong, 0) << "seed " << seed;
    EXPECT_GT(inside, 2000) << "seed " << seed;
  }
}

TEST(PolygonFill, HasNothingBesideTheTerrainOrOfLines) {
  const TerrainModel model = plain();
  FeatureLayer layer;
  layer.vertices = {{5000, 0}, {5001, 0}, {5001, 1}, {5000, 0}};
  layer.lines = {{0, 4, 0}};
  EXPECT_FALSE(fillOf(layer, model, {}));
  layer.vertices = {{1010, 1990}, {1020, 1990}, {1020, 1980}, {1010, 1990}};
  layer.lines = {{0, 4}};
  EXPECT_FALSE(fillOf(layer, model, {}));
}

TEST(PolygonFill, PaintsNothingBesideItsAreaHoweverFarAway) {
  const TerrainModel model = plain();
  FeatureLayer layer;
  layer.vertices = {{1010, 1970}, {1200, 1970}, {1200, 1950}, {1010, 1950}, {1010, 1970}};
  layer.lines = {{0, 5, 0}};
  ViewSettings settings;
  settings.look.isShaded = false;
  settings.look.coloring = Coloring::plain;
  for (const double distance : {150.0, 2000.0}) {
    auto view = HeadlessView::create(
        model, {.widthPixels = 200, .heightPixels = 120, .samples = 1, .settings = settings});
    if (!view) GTEST_SKIP() << view.error().describe();
    const Camera camera{.xy = {1105, 1950}, .height = distance, .pitchDegrees = -90};
    ASSERT_TRUE(view->draw(camera));
    const Image none = view->image();
    view->scene().layers.put("area", std::make_shared<const PlanPicture>(*fillOf(layer, model, {200, 0, 0})));
    ASSERT_TRUE(view->draw(camera));
    const Image filled = view->image();
    // Rows of the picture, from its middle: y - 1950 in pixels.
    const double perMetre = 120 / (2 * (distance - 5) * std::tan(30 * 3.14159265358979 / 180));
    int changed = 0, beside = 0;
    for (int row = 0; row < 120; ++row)
      for (int column = 0; column < 200; ++column)
        if (!(none.at(column, row) == filled.at(column, row))) {
          ++changed;
          const double y = (60 - row - 0.5) / perMetre;
          beside += y < -1.5 / perMetre || y > 20 + 1.5 / perMetre ? 1 : 0;
        }
    EXPECT_GT(changed, 10) << distance;
    EXPECT_EQ(beside, 0) << distance;
  }
}

}  // namespace
}  // namespace arete
