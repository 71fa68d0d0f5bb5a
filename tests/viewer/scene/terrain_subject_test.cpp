// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/scene/terrain_subject.h"

#include <gtest/gtest.h>

#include <cmath>

#include "terrain/builder/build.h"
#include "viewer/camera_models.h"

namespace arete {
namespace {

using test::cameraModels;

TerrainModel plane(double perColumn, double perRow) {
  RasterHeightfield field;
  field.columns = 40;
  field.rows = 30;
  for (std::uint32_t row = 0; row < field.rows; ++row)
    for (std::uint32_t column = 0; column < field.columns; ++column)
      field.heights.push_back(100 + perColumn * column + perRow * row);
  field.georeference.geoTransform = {500000, 30, 0, 4000000, 0, -30};
  field.georeference.hasGeoTransform = true;
  field.georeference.crsWkt = "a projected CRS";
  auto model = build(field);
  EXPECT_TRUE(model);
  return std::move(*model);
}

/// Where a ray meets the surface, found by walking: a ten-thousandth of the way at a time, then by halves.
std::optional<Vec3> walked(const TerrainSubject& subject, const Vec3& eye, const Vec3& d, double far) {
  const CameraSpace& space = subject.space();
  const GroundHeights& heights = *subject.heights();
  const auto above = [&](double t) -> std::optional<double> {
    const Vec3 p{eye.x + t * d.x, eye.y + t * d.y, eye.z + t * d.z};
    const auto ground = heights.at(space.xy(p));
    if (!ground) return std::nullopt;
    return p.z - space.position(space.xy(p), ground->height).z;
  };
  std::optional<double> before;
  double at = 0;
  for (int i = 0; i <= 10000; ++i) {
    const double t = far * i / 10000;
    const auto now = above(t);
    if (before && now && (*before > 0) != (*now > 0)) {
      double low = at, high = t;
      for (int k = 0; k < 60; ++k) {
        const double middle = (low + high) / 2;
        const auto there = above(middle);
        if (!there) return std::nullopt;
        ((*there > 0) == (*before > 0) ? low : high) = middle;
      }
      return Vec3{eye.x + low * d.x, eye.y + low * d.y, eye.z + low * d.z};
    }
    before = now;
    at = t;
  }
  return std::nullopt;
}

TEST(Picking, OnAPlaneItIsWhereTheRayMeetsThePlane) {
  const TerrainModel model = plane(2, -1.5);
  const TerrainSubject subject(model);
  Random random(3);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Camera camera{.xy = {random.between(500000, 501200), random.between(3999100, 4000000)},
                        .height = random.between(250, 3000),
                        .azimuthDegrees = random.between(0, 360),
                        .pitchDegrees = random.between(-90, 10),
                        .widthPixels = 800,
                        .heightPixels = 600};
    const Vec2 pixel{random.between(0, 800), random.between(0, 600)};
    const auto pick = subject.pick(camera, pixel);
    if (!pick) continue;
    ++hits;
    // The height of the plane there, in terms of the source.
    const double column = (pick->xy.x - 500015) / 30, row = (3999985 - pick->xy.y) / 30;
    EXPECT_NEAR(pick->height, 100 + 2 * column - 1.5 * row, 1e-6) << "camera " << i;
    EXPECT_NEAR(pick->plan.x, column, 1e-6);
    const auto seen = pixelOf(subject, camera, pick->metric);
    ASSERT_TRUE(seen);
    EXPECT_NEAR(seen->x, pixel.x, 1e-4);
    EXPECT_NEAR(seen->y, pixel.y, 1e-4);
  }
  EXPECT_GT(hits, 100);
}

TEST(Picking, OnEveryKindOfGridItIsTheFirstPlaceThatAWalkAlongTheRayFinds) {
  for (const test::CameraModel& m : cameraModels()) {
    SCOPED_TRACE(m.name);
    const TerrainSubject subject(m.model);
    const double far = 3 * subject.box().diagonal();
    Random random(17);
    int hits = 0;
    for (int i = 0; i < 60; ++i) {
      Camera camera = homeCamera(HomeView::overview, subject.space(), subject.box(),
                                 {.widthPixels = 800, .heightPixels = 600});
      const Vec3 c = subject.box().centre();
      camera = subject.space().at(
          camera, {c.x + random.between(-0.5, 0.5) * far / 3, c.y + random.between(-0.5, 0.5) * far / 3,
                   subject.box().high.z + random.between(0.01, 0.5) * far / 3});
      camera.azimuthDegrees = random.between(0, 360);
      camera.pitchDegrees = random.between(-80, 0);
      const Vec2 pixel{random.between(0, 800), random.between(0, 600)};
      Vec3 d = directionOfPixel(*viewOf(camera, subject.space()), subject.space().isMirrored(), pixel);
      const double length = std::hypot(d.x, d.y, d.z);
      d = {d.x / length, d.y / length, d.z / length};
      const auto found = walked(subject, subject.space().position(camera), d, far);
      const auto pick = subject.pick(camera, pixel);
      if (!found) continue;  // the walk may step over a crest that the ray meets
      ++hits;
      ASSERT_TRUE(pick) << "camera " << i;
      const double there = test::apart(subject.space().position(camera), *found);
      EXPECT_LE(pick->metres, there + 1e-6 * far);
      const bool isThere = pick->metres > there - 1e-6 * far;
      EXPECT_LT(isThere ? test::apart(pick->metric, *found) : 0, 1e-6 * far);
      const auto ground = subject.heights()->at(pick->xy);
      ASSERT_TRUE(ground);
      EXPECT_NEAR(ground->height, pick->height, 1e-6 * far) << "a pick lies on the terrain";
    }
    EXPECT_GT(hits, 5);
  }
}

TEST(Picking, ExaggeratedHeightsArePickedWhereTheyAreDrawn) {
  const TerrainModel& model = cameraModels()[0].model;
  const TerrainSubject subject(model);
  const Camera camera = homeCamera(HomeView::overview, subject.space(), subject.box());
  for (const double stretch : {0.5, 1.0, 4.0}) {
    const auto pick = subject.pick(camera, {960, 560}, {.stretch = stretch});
    if (!pick) continue;
    const auto seen = pixelOf(subject, camera, pick->metric, {.stretch = stretch});
    ASSERT_TRUE(seen);
    EXPECT_NEAR(seen->x, 960, 1e-4);
    EXPECT_NEAR(seen->y, 560, 1e-4);
    EXPECT_NEAR(subject.heights()->at(pick->xy)->height, pick->height, 1e-6);
  }
}

TEST(Picking, StraightDownIsTheGroundBelowAndTheSkyIsNothing) {
  for (const test::CameraModel& m : cameraModels()) {
    SCOPED_TRACE(m.name);
    const TerrainSubject subject(m.model);
    const Vec3 c = subject.box().centre();
    const Vec3 eye{c.x, c.y, subject.box().high.z + 100};
    const auto pick = subject.along(eye, {0, 0, -3});
    const auto ground = subject.heights()->at(subject.space().xy(eye));
    ASSERT_EQ(pick.has_value(), ground.has_value());
    if (pick) {
      EXPECT_NEAR(pick->height, ground->height, 1e-9 * std::abs(ground->height) + 1e-9);
    }
    EXPECT_FALSE(subject.along(eye, {0, 0, 1}));
    EXPECT_FALSE(subject.along(eye, {1, 0, 0.2}));
  }
}

}  // namespace
}  // namespace arete
