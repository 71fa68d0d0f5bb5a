// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/model/camera.h"

#include <gtest/gtest.h>

#include <cmath>

#include "datasets/families.h"
#include "terrain/builder/build.h"

namespace arete {
namespace {

TerrainModel modelWith(const std::array<double, 6>& geoTransform, bool isGeographic = false) {
  RasterHeightfield field = rasterFamilies()[2].make(40, 30, 1);
  field.georeference.geoTransform = geoTransform;
  field.georeference.hasGeoTransform = true;
  field.georeference.crsWkt = isGeographic ? "a geographic CRS" : "a projected CRS";
  field.georeference.isGeographic = isGeographic;
  return build(field).value();
}

/// Where the axis of the view meets the level of the eye's feet, seen on the map, relative to the eye.
Vec2 onTheMap(const View& view, const TerrainModel& model) {
  const MetricFrame& metric = model.mt.arrays().metric;
  const auto toMap = [&](double x, double y) {
    return model.toSource({x / metric.scale.x + metric.origin.x, y / metric.scale.y + metric.origin.y});
  };
  const Vec2 eye = toMap(view.eye.x, view.eye.y);
  const Vec2 there = toMap(view.eye.x + 100 * view.forward.x, view.eye.y + 100 * view.forward.y);
  return {there.x - eye.x, there.y - eye.y};
}

TEST(Camera, LooksWhereTheCompassSaysOnEveryGrid) {
  const double c = std::cos(0.4) * 30, s = std::sin(0.4) * 30;
  for (const auto& g : {std::array<double, 6>{500000, 30, 0, 4000000, 0, -30},   // north up
                        std::array<double, 6>{500000, 30, 0, 4000000, 0, 30},    // south up
                        std::array<double, 6>{500000, c, s, 4000000, s, -c}}) {  // turned
    const TerrainModel model = modelWith(g);
    for (const double azimuth : {0.0, 90.0, 135.0, -60.0, 300.0}) {
      const Vec2 middle = model.toSource({20, 15});
      const auto view = viewOf({.xy = middle, .height = 100, .azimuthDegrees = azimuth}, model);
      ASSERT_TRUE(view);
      const Vec2 d = onTheMap(*view, model);
      EXPECT_NEAR(d.x, 100 * std::sin(azimuth * M_PI / 180), 1e-6);
      EXPECT_NEAR(d.y, 100 * std::cos(azimuth * M_PI / 180), 1e-6);
      EXPECT_TRUE(view->validate());
    }
  }
}

TEST(Camera, MeasuresAzimuthsOnTheGroundWhereADegreeOfLongitudeIsShort) {
  const TerrainModel model = modelWith({10, 0.001, 0, 60.015, 0, -0.001}, true);
  const auto view = viewOf({.xy = {10.02, 60}, .azimuthDegrees = 45}, model);
  ASSERT_TRUE(view);
  const Vec2 d = onTheMap(*view, model);
  EXPECT_NEAR(d.x / d.y, 2, 0.01) << "as far east as north is twice as many degrees at 60 degrees north";
}

TEST(Camera, PitchesUpAndStraightDown) {
  const TerrainModel model = modelWith({0, 10, 0, 0, 0, -10});
  const auto down =
      viewOf({.xy = {200, -150}, .height = 500, .azimuthDegrees = 30, .pitchDegrees = -90}, model);
  ASSERT_TRUE(down);
  EXPECT_NEAR(down->forward.z, -1, 1e-12);
  const auto up = viewOf({.xy = {200, -150}, .height = 500, .pitchDegrees = 30}, model);
  ASSERT_TRUE(up);
  EXPECT_NEAR(up->forward.z, 0.5, 1e-12);
  EXPECT_NEAR(up->eye.z, 500 - model.mt.arrays().metric.origin.z, 1e-9);
}

TEST(Camera, NamesWhatMakesNoSense) {
  const TerrainModel model = modelWith({0, 10, 0, 0, 0, -10});
  EXPECT_NE(viewOf({.pitchDegrees = 91}, model).error().message.find("pitch"), std::string::npos);
  EXPECT_NE(viewOf({.azimuthDegrees = INFINITY}, model).error().message.find("azimuth"), std::string::npos);
  EXPECT_NE(viewOf({.verticalFieldOfViewDegrees = 180}, model).error().message.find("field of view"),
            std::string::npos);
}

}  // namespace
}  // namespace arete
