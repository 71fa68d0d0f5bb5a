// SPDX-License-Identifier: GPL-3.0-or-later
//
// A click meets what is drawn in front, in either projection, and places of further terrain, which has a
// metric space of its own, come back in the scene's.
#include "viewer/scene/scene_subject.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "surface/builder/build.h"
#include "surface/families.h"
#include "terrain/builder/build.h"
#include "viewer/scene/terrain_subject.h"
#include "viewer/surface/surface_subject.h"

namespace arete {
namespace {

/// Flat ground, 500 m wide, with its western side at a place of the map.
TerrainModel flat(double west, float height) {
  RasterHeightfield field;
  field.columns = field.rows = 51;
  field.heights.assign(51 * 51, height);
  field.georeference.geoTransform = {west, 10, 0, 2000, 0, -10};
  field.georeference.hasGeoTransform = true;
  return std::move(*build(field));
}

/// A rod of length 2 along x.
SurfaceModel rod() {
  SurfaceMesh mesh(shapes::globe(24, 16));
  double size = 0;
  for (const Vec3& p : mesh.positions) size = std::max(size, std::abs(p.x));
  for (Vec3& p : mesh.positions) p = {p.x / size, p.y / size / 10, p.z / size / 10};
  return std::move(*buildSurface(std::move(mesh)));
}

struct RodsOverGround {
  TerrainModel terrain = flat(1000, 100);
  SurfaceModel model = rod();
  TerrainSubject ground{terrain};
  std::shared_ptr<const SurfaceForm> form = std::make_shared<const SurfaceForm>(model, ZUpFrame(model));

  SurfaceSubject at(const Vec3& place, double scale) const {
    return {form, {.anchor = ground.space().position({place.x, place.y}, place.z), .scale = scale}, &ground};
  }
};

Camera down(double parallelHeight) {
  return {.xy = {1250, 1750},
          .height = 200,
          .pitchDegrees = -90,
          .widthPixels = 100,
          .heightPixels = 100,
          .parallelHeight = parallelHeight};
}

TEST(SceneSubject, AClickMeetsWhatIsDrawnInFrontInEitherProjection) {
  const RodsOverGround scene;
  // In parallel projection what is behind the eye is in front of all before it.
  const SurfaceSubject low = scene.at({1250, 1750, 150}, 10), behind = scene.at({1250, 1750, 300}, 10);
  const SceneSubject all({&scene.ground, &low, &behind});
  for (const double stretch : {1.0, 3.0}) {
    ViewSettings settings;
    settings.stretch = stretch;
    const auto parallel = all.pick(down(60), {50, 50}, settings);
    ASSERT_TRUE(parallel);
    EXPECT_EQ(parallel->object, 2u) << stretch;
    EXPECT_LT(parallel->depth, 0);
    const auto perspective = all.pick(down(0), {50, 50}, settings);
    ASSERT_TRUE(perspective);
    EXPECT_EQ(perspective->object, 1u) << stretch;
  }
}

// Beside it the ground at three times its height is farther than an object whose height is as it is.
TEST(SceneSubject, AClickOnExaggeratedGroundMeetsWhatIsDrawnInFront) {
  const RodsOverGround scene;
  ViewSettings settings;
  settings.stretch = 5;
  const SurfaceSubject low = scene.at({1250, 1750, 99.5}, 10);
  const SceneSubject all({&scene.ground, &low});
  const auto found = all.pick(down(0), {50, 50}, settings);
  ASSERT_TRUE(found);
  // It is drawn 2.5 m below the ground's anchor, and is 1 m thick.
  EXPECT_EQ(found->object, 0u);
  settings.stretch = 1;
  EXPECT_EQ(all.pick(down(0), {50, 50}, settings)->object, 1u);
}

TEST(SceneSubject, ItsBoxFollowsObjectsThatMove) {
  const RodsOverGround scene;
  SurfaceSubject one = scene.at({1250, 1750, 400}, 100);
  const SceneSubject all({&scene.ground, &one});
  EXPECT_NEAR(all.box().high.z - all.box().low.z, 310, 1);
  Placement placement = one.placement();
  placement.turn.roll = 90;
  one.place(placement);
  EXPECT_NEAR(all.box().high.z - all.box().low.z, 400, 1);
}

TEST(SceneSubject, PlacesOfFurtherTerrainAreInTheSpaceOfTheFirst) {
  const TerrainModel east = flat(1500, 130);
  const RodsOverGround scene;
  const TerrainSubject further(east);
  const SceneSubject all({&scene.ground, &further});
  const MetricBox box = all.box();
  EXPECT_NEAR(box.high.z - box.low.z, 30, 1e-6);
  EXPECT_NEAR(box.high.x - box.low.x, 1000, 1e-6) << "samples 500 m apart, twice";
  Camera camera = down(0);
  camera.xy = {1700, 1800};
  const auto found = all.pick(camera, {50, 50}, {});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->object, 1u);
  const Vec3 should = scene.ground.space().position({1700, 1800}, 130);
  EXPECT_LT(norm(found->metric - should), 1e-6);
  EXPECT_LT(norm(all.inFile(found->metric) - Vec3{1700, 1800, 130}), 1e-6);
}

}  // namespace
}  // namespace arete
