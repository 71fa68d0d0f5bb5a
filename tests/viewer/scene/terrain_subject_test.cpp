// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/scene/terrain_subject.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

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

/// The direction of a pixel, by the axes of the camera.
Vec3 directionIn(const CameraSpace& space, const Camera& camera, Vec2 pixel) {
  const double slope = std::tan(camera.verticalFieldOfViewDegrees * std::numbers::pi / 360);
  const double aspect = camera.widthPixels / camera.heightPixels;
  const double x = (2 * pixel.x / camera.widthPixels - 1) * slope * aspect;
  const double y = (1 - 2 * pixel.y / camera.heightPixels) * slope;
  return space.forward(lookOf(camera)) + x * space.right(camera.azimuthDegrees) +
         y * space.up(lookOf(camera));
}

/// Cameras at every zoom: from far outside down to a hundredth of a sample above the ground, with wide and
/// narrow lenses, level, steep and from below.
Camera anyCamera(Random& random, const TerrainSubject& picker) {
  const GroundHeights& heights = *picker.heights();
  const MetricBox& box = picker.box();
  const double size = box.diagonal(), zoom = std::pow(10, random.between(-5, 1)) * size;
  Vec3 eye{random.between(box.low.x, box.high.x), random.between(box.low.y, box.high.y), box.high.z};
  if (const auto ground = heights.at(picker.space().xy(eye)))
    eye.z = picker.space().position(picker.space().xy(eye), ground->height).z;
  Camera camera =
      picker.space().at({}, {eye.x + random.between(-1, 1) * zoom, eye.y + random.between(-1, 1) * zoom,
                             eye.z + random.between(-0.1, 1) * zoom});
  camera.azimuthDegrees = random.between(0, 360);
  camera.pitchDegrees = random.below(8) == 0 ? random.between(-1, 1) : random.between(-90, 30);
  camera.verticalFieldOfViewDegrees = std::pow(10, random.between(-0.5, 2.1));
  camera.widthPixels = random.below(2) == 0 ? 800 : 300;
  camera.heightPixels = 600;
  return camera;
}

/// Picks until there are so many on the ground, and checks each.
void checkPicks(const std::string& name, const TerrainModel& model, int wanted, std::uint64_t seed) {
  const TerrainSubject picker(model);
  Random random(seed);
  int hits = 0;
  for (int tries = 0; hits < wanted && tries < 60 * wanted; ++tries) {
    const Camera camera = anyCamera(random, picker);
    const double stretch = random.below(2) == 0 ? 1 : std::pow(10, random.between(-0.5, 1));
    for (int k = 0; k < 8; ++k) {
      const Vec2 pixel{random.between(0, camera.widthPixels), random.between(0, camera.heightPixels)};
      const auto pick = picker.pick(camera, pixel, {.stretch = stretch});
      if (!pick) continue;
      ++hits;
      const auto ground = picker.heights()->at(pick->xy);
      ASSERT_TRUE(ground) << name << ", seed " << seed << ", pick " << hits;
      ASSERT_EQ(pick->height, ground->height) << name << ", seed " << seed << ", pick " << hits;
      // The place is on the ray but for rounding: of heights, of coordinates in the source, and of the angle
      // that a pixel is.
      const CameraSpace& space = picker.space();
      const Vec3 d = directionIn(space, camera, pixel);
      Vec3 to = pick->metric - space.position(camera);
      to.z *= stretch;
      const Vec3 off = cross(to, d);
      const double away = norm(off) / norm(d);
      ASSERT_LE(away, 1e-7 * (norm(to) + std::max(1.0, stretch) * picker.box().diagonal()))
          << name << ", seed " << seed << ", pick " << hits;
      ASSERT_GE(dot(to, d), 0) << "in front of the camera";
    }
  }
  EXPECT_GE(hits, wanted) << name;
}

TEST(Picking, APickedHeightIsThatOfTheGroundThereAtEveryZoom) {
  std::uint64_t seed = 20;
  for (const test::CameraModel& m : cameraModels()) checkPicks(m.name, m.model, 5000, ++seed);
}

class PickingOn : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(ThirdsOfTheFamilies, PickingOn, testing::Range(0, 3));

TEST_P(PickingOn, APickedHeightIsThatOfTheGroundThereOnRastersWithAndWithoutVoids) {
  std::uint64_t seed = 40;
  for (std::size_t i = std::size_t(GetParam()); i < rasterFamilies().size(); i += 3) {
    const RasterFamily& family = rasterFamilies()[i];
    checkPicks(std::string(family.name), test::modelOn(family, {500000, 30, 0, 4000000, 0, -30}), 3000,
               seed + i);
  }
}

TEST(Picking, APickedHeightIsThatOfTheGroundThereOnPoints) {
  std::uint64_t seed = 70;
  for (const PointFamily& family : pointFamilies()) {
    auto made = build(family.make(300, 9));
    ASSERT_TRUE(made);
    checkPicks(std::string(family.name), *made, 4000, ++seed);
  }
}

using Triangle3 = std::array<Vec3, 3>;

/// In metric space.
std::vector<Triangle3> finestTrianglesOf(const TerrainModel& model) {
  std::vector<Triangle3> all;
  for (std::uint32_t t = 0; t < model.mt.triangleIdCount(); ++t) {
    if (model.mt.remover(TriangleId(t)).isValid()) continue;
    Triangle3 corners;
    for (std::size_t i = 0; i < 3; ++i) {
      const VertexId v(model.mt.corners(TriangleId(t))[i]);
      corners[i] = model.mt.metric().toMetric(model.mt.position(v));
    }
    all.push_back(corners);
  }
  return all;
}

/// The first meeting of a ray with triangles, each of which is tried by Cramer's rule. Empty: it meets none.
std::optional<double> firstTriangle(const std::vector<Triangle3>& triangles, const Vec3& eye, const Vec3& d) {
  std::optional<double> first;
  for (const auto& [a, b, c] : triangles) {
    const Vec3 u = b - a, v = c - a, p = cross(d, v), s = eye - a, q = cross(s, u);
    const double determinant = dot(u, p);
    if (determinant == 0) continue;
    const double atB = dot(s, p) / determinant, atC = dot(d, q) / determinant,
                 along = dot(v, q) / determinant;
    constexpr double kEdge = 1e-9;
    if (atB < -kEdge || atC < -kEdge || atB + atC > 1 + kEdge || along < 0) continue;
    if (!first || along < *first) first = along;
  }
  return first;
}

TEST(Picking, TheFirstTriangleOfAllThatTheRayMeetsIsPickedAndRaysThatMeetNoneMiss) {
  std::uint64_t seed = 100;
  for (const RasterFamily& family : rasterFamilies()) {
    const TerrainModel model = test::modelOn(family, {500000, 30, 0, 4000000, 0, -30});
    const TerrainSubject picker(model);
    Random random(++seed);
    const std::vector<Triangle3> triangles = finestTrianglesOf(model);
    int hits = 0, misses = 0;
    for (int i = 0; i < 300; ++i) {
      const Camera camera = anyCamera(random, picker);
      const Vec2 pixel{random.between(0, camera.widthPixels), random.between(0, camera.heightPixels)};
      const Vec3 eye = picker.space().position(camera), d = directionIn(picker.space(), camera, pixel);
      const auto first = firstTriangle(triangles, eye, d);
      const auto pick = picker.pick(camera, pixel);
      (first ? hits : misses) += 1;
      const bool isSame = first.has_value() == pick.has_value() &&
                          (!first || std::abs(pick->metres - *first * norm(d)) <=
                                         1e-6 * (pick->metres + picker.box().diagonal()));
      EXPECT_TRUE(isSame) << family.name << ", seed " << seed << ", ray " << i << ": "
                          << (first ? *first * norm(d) : -1) << " m and " << (pick ? pick->metres : -1)
                          << " m";
    }
    EXPECT_GT(hits, 5) << family.name;
    EXPECT_GT(misses, 20) << family.name;
  }
}

}  // namespace
}  // namespace arete
