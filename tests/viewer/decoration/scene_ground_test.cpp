// SPDX-License-Identifier: GPL-3.0-or-later
// A plain in UTM under a camera: places, lengths and directions against a ray that meets a plane.
#include "viewer/decoration/scene_ground.h"

#include <gtest/gtest.h>

#include <GeographicLib/UTMUPS.hpp>
#include <cmath>
#include <limits>
#include <memory>

#include "terrain/builder/build.h"
#include "viewer/decoration/graticule.h"
#include "viewer/decoration/north_arrow.h"
#include "viewer/decoration/scale_bar.h"
#include "viewer/scene/terrain_subject.h"

namespace arete {
namespace {

/// 3 km wide and level, 100 high, about (500000, 5000000) in UTM zone 33.
TerrainModel plain(const std::string& crs = "EPSG:32633") {
  RasterHeightfield field;
  field.columns = field.rows = 101;
  field.heights.assign(101 * 101, 100);
  field.georeference.hasGeoTransform = true;
  field.georeference.crsWkt = crs;
  field.georeference.verticalUnit = "m";
  field.georeference.geoTransform = {500000 - 50.5 * 30, 30, 0, 5000000 + 50.5 * 30, 0, -30};
  Result<TerrainModel> model = build(field);
  EXPECT_TRUE(model) << model.error().describe();
  return std::move(*model);
}

Camera cameraAt(double azimuth, double pitch) {
  Camera camera;
  camera.xy = {500000, 5000000};
  camera.height = 400;
  camera.azimuthDegrees = azimuth;
  camera.pitchDegrees = pitch;
  camera.verticalFieldOfViewDegrees = 60;
  camera.widthPixels = 640;
  camera.heightPixels = 480;
  return camera;
}

/// Depths of the level plain 300 below the eye, which ends 1500 away from the middle.
std::shared_ptr<PictureDepths> depthsOf(const TerrainSubject& subject, const Camera& camera) {
  auto picture = std::make_shared<PictureDepths>(PictureDepths{640, 480, {}});
  const Result<View> view = subject.viewOf(camera, {});
  EXPECT_TRUE(view);
  for (int y = 0; y < 480; ++y)
    for (int x = 0; x < 640; ++x) {
      const Vec3 d = directionOfPixel(*view, subject.space().isMirrored(), {x + 0.5, y + 0.5});
      const double t = d.z < 0 ? 300 / -d.z : std::numeric_limits<double>::infinity();
      const bool isOnPlain = std::abs(t * d.x) < 1500 && std::abs(t * d.y) < 1500;
      picture->depths.push_back(isOnPlain ? float(t) : std::numeric_limits<float>::infinity());
    }
  return picture;
}

TEST(SceneGround, MeasuresLevelLengthsAcrossTheView) {
  const TerrainModel model = plain();
  const TerrainSubject subject(model);
  for (const double azimuth : {0.0, 70.0, 200.0})
    for (const double pitch : {-80.0, -30.0, -15.0}) {
      const Camera camera = cameraAt(azimuth, pitch);
      const PictureGround ground = groundInView(subject, camera, {}, depthsOf(subject, camera));
      const auto bar = scaleBarOf(ground, 200);
      ASSERT_TRUE(bar) << pitch;
      const double distance = 300 / std::sin(-pitch * 3.14159265358979 / 180);
      const double perPixel = 2 * distance * std::tan(30 * 3.14159265358979 / 180) / 480 / 0.9996;
      EXPECT_NEAR(bar->length / bar->pixels, perPixel, 0.01 * perPixel) << azimuth << ", " << pitch;
      EXPECT_EQ(bar->where, "at the middle");
    }
}

TEST(SceneGround, PointsToTheNorthOfTheGround) {
  const TerrainModel model = plain();
  const TerrainSubject subject(model);
  for (const double azimuth : {0.0, 45.0, 90.0, 180.0, 300.0}) {
    const Camera camera = cameraAt(azimuth, -89);
    const auto arrow = northArrowOf(groundInView(subject, camera, {}, depthsOf(subject, camera)));
    ASSERT_TRUE(arrow);
    const double clockwise = std::atan2(arrow->toNorth.x, -arrow->toNorth.y) * 180 / 3.14159265358979;
    EXPECT_NEAR(std::remainder(clockwise + azimuth, 360), 0, 1) << azimuth;
    EXPECT_EQ(arrow->words.front(), "true north");
  }
}

TEST(SceneGround, NorthFollowsTheAzimuthWhateverThePitch) {
  const TerrainModel model = plain();
  const TerrainSubject subject(model);
  for (const double azimuth : {0.0, 135.0, 270.0}) {
    std::optional<Vec2> before;
    for (double pitch = -85; pitch <= 60; pitch += 10) {
      const Camera camera = cameraAt(azimuth, pitch);
      const auto arrow = northArrowOf(groundInView(subject, camera, {}, depthsOf(subject, camera)));
      ASSERT_TRUE(arrow) << azimuth << ", " << pitch;
      const double turn = azimuth * 3.14159265358979 / 180, x = -std::sin(turn), y = -std::cos(turn);
      EXPECT_GT(dot(arrow->toNorth, {x, y}), pitch < 0 ? 0.9 : 0.9999) << azimuth << ", " << pitch;
      if (before) {
        EXPECT_GT(dot(*before, arrow->toNorth), 0.98) << "jumps at " << azimuth << ", " << pitch;
      }
      before = arrow->toNorth;
    }
  }
}

TEST(SceneGround, HasMeridiansWhereTheGroundIsAndNothingHidesThem) {
  const TerrainModel model = plain();
  const TerrainSubject subject(model);
  const Camera camera = cameraAt(20, -35);
  const auto depths = depthsOf(subject, camera);
  const PictureGround ground = groundInView(subject, camera, {}, depths);
  const auto lines = graticuleOf(ground, 120);
  ASSERT_GE(lines.size(), 4u);
  int checked = 0;
  for (const auto& line : lines)
    for (const auto& part : line.parts)
      for (const Vec2 p : part) {
        const auto pick = subject.pick(camera, p);
        if (!pick || p.x < 1 || p.y < 1 || p.x > 639 || p.y > 479) continue;
        double latitude = 0, longitude = 0;
        GeographicLib::UTMUPS::Reverse(33, true, pick->xy.x, pick->xy.y, latitude, longitude);
        EXPECT_NEAR(line.isMeridian ? longitude : latitude, line.degrees, 1e-7) << line.label;
        ++checked;
      }
  EXPECT_GT(checked, 100);
  // Something stands in front of the left half.
  for (int y = 0; y < 480; ++y)
    for (int x = 0; x < 320; ++x) depths->depths[std::size_t(y) * 640 + std::size_t(x)] = 10;
  for (const auto& line : graticuleOf(groundInView(subject, camera, {}, depths), 120))
    for (const auto& part : line.parts)
      for (const Vec2 p : part)
        if (p.y > 0 && p.y < 480 && p.x > 0) {
          EXPECT_GE(p.x, 319) << "is hidden";
        }
}

TEST(SceneGround, OfASkyOrWithoutACrsClaimsNothing) {
  const TerrainModel model = plain();
  const TerrainSubject subject(model);
  const Camera up = cameraAt(0, 60);
  const PictureGround sky = groundInView(subject, up, {}, depthsOf(subject, up));
  EXPECT_FALSE(scaleBarOf(sky, 200));
  EXPECT_TRUE(northArrowOf(sky)) << "which says where the camera looks";
  EXPECT_TRUE(graticuleOf(sky, 120).empty());
  const TerrainModel plane = plain("");
  const TerrainSubject without(plane);
  const Camera down = cameraAt(0, -45);
  const PictureGround ground = groundInView(without, down, {}, depthsOf(without, down));
  const auto bar = scaleBarOf(ground, 200);
  ASSERT_TRUE(bar);
  EXPECT_NE(bar->label.find("units"), std::string::npos);
  EXPECT_FALSE(northArrowOf(ground));
  EXPECT_TRUE(graticuleOf(ground, 120).empty());
}

}  // namespace
}  // namespace arete
