// SPDX-License-Identifier: GPL-3.0-or-later
// A camera on a sphere around its target.
#include "viewer/camera/orbit_camera.h"

#include <gtest/gtest.h>
#include <cmath>

#include "viewer/camera/free_camera.h"
#include "viewer/camera_models.h"

namespace arete {
namespace {

using test::apart;
using test::inPicture;

void expectSamePicture(const Camera& a, const Camera& b, const TerrainModel& model, double slack) {
  const CameraSpace space(model);
  EXPECT_LT(apart(space.position(a), space.position(b)), slack);
  EXPECT_LT(apart(space.forward(lookOf(a)), space.forward(lookOf(b))), 1e-9);
  EXPECT_LT(apart(space.up(lookOf(a)), space.up(lookOf(b))), 1e-9);
  EXPECT_EQ(a.verticalFieldOfViewDegrees, b.verticalFieldOfViewDegrees);
  EXPECT_EQ(a.widthPixels, b.widthPixels);
}

TEST(OrbitCamera, KeepsThePictureOfACameraThatItTakesOverAndBack) {
  for (const auto& [name, model] : test::cameraModels()) {
    const CameraSpace space(model);
    Random random(3);
    for (int i = 0; i < 100; ++i) {
      SCOPED_TRACE(name + ", seed 3, camera " + std::to_string(i));
      const Camera free = test::randomCamera(random, model);
      OrbitCamera orbit = OrbitCamera::of(space, free, random.between(1, 5000));
      expectSamePicture(free, orbit.camera(), model, 1e-5);
      expectSamePicture(free, FreeCamera(space, orbit.camera()).camera(), model, 1e-5);
    }
  }
}

TEST(OrbitCamera, LooksAtItsTargetFromItsRadiusHoweverItTurns) {
  for (const auto& [name, model] : test::cameraModels()) {
    const CameraSpace space(model);
    Random random(4);
    OrbitCamera orbit(space, {.target = {12, -30, 5}, .radius = 700});
    for (int i = 0; i < 200; ++i) {
      SCOPED_TRACE(name + ", seed 4, turn " + std::to_string(i));
      orbit.turn(random.between(-200, 200), random.between(-60, 60));
      const Camera camera = orbit.camera();
      ASSERT_NEAR(apart(space.position(camera), orbit.orbit().target), 700, 1e-5);
      const auto middle = inPicture(camera, orbit.orbit().target, model);
      ASSERT_TRUE(middle);
      ASSERT_NEAR(middle->x, 0, 1e-8);
      ASSERT_NEAR(middle->y, 0, 1e-8);
      ASSERT_TRUE(viewOf(camera, model)) << "a pitch beyond the vertical is none";
    }
  }
}

TEST(OrbitCamera, StandsSouthOfItsTargetAtAzimuthZero) {
  for (const auto& [name, model] : test::cameraModels()) {
    if (name == "sheared") continue;  // north is not at right angles to east there
    const CameraSpace space(model);
    const Vec2 target = model.toSource({20, 12});
    const OrbitCamera orbit(space, {.target = space.position(target, 0), .zenithDegrees = 60, .radius = 100});
    const Camera camera = orbit.camera();
    EXPECT_LT(camera.xy.y, target.y) << name;
    EXPECT_NEAR(camera.xy.x, target.x, 1e-6) << name;
    EXPECT_NEAR(camera.height * space.metresPerHeight(), 50, 1e-6) << name;
  }
}

TEST(OrbitCamera, ZoomsToAndFroWithinItsLimitsAndKeepsThePointUnderTheMouse) {
  const auto& [name, model] = test::cameraModels()[2];
  const CameraSpace space(model);
  Random random(5);
  for (int i = 0; i < 100; ++i) {
    OrbitCamera orbit(space, {.target = {0, 0, 0},
                              .azimuthDegrees = random.between(0, 360),
                              .zenithDegrees = random.between(0, 85),
                              .radius = 1000});
    const Vec3 point{random.between(-200, 200), random.between(-200, 200), random.between(-50, 50)};
    const auto before = inPicture(orbit.camera(), point, model);
    orbit.zoomAbout(point, random.between(0.3, 3));
    const auto after = inPicture(orbit.camera(), point, model);
    ASSERT_TRUE(before && after);
    EXPECT_NEAR(before->x, after->x, 1e-7) << "seed 5, " << i;
    EXPECT_NEAR(before->y, after->y, 1e-7) << "seed 5, " << i;
  }
  OrbitCamera orbit(space, {.radius = 1000});
  orbit.limitRadius(10, 5000);
  orbit.zoom(1e-9);
  EXPECT_EQ(orbit.orbit().radius, 10);
  orbit.zoom(1e9);
  EXPECT_EQ(orbit.orbit().radius, 5000);
}

TEST(OrbitCamera, PansTheTargetByMetresInThePicture) {
  for (const auto& [name, model] : test::cameraModels()) {
    const CameraSpace space(model);
    OrbitCamera orbit(space, {.azimuthDegrees = 50, .zenithDegrees = 40, .radius = 300});
    const Vec3 old = orbit.orbit().target;
    orbit.pan(3, 4);
    EXPECT_NEAR(apart(old, orbit.orbit().target), 5, 1e-9) << name;
    const auto seen = inPicture(orbit.camera(), old, model);
    ASSERT_TRUE(seen);
    EXPECT_LT(seen->y, 0) << name << ": the camera went up";
    orbit = OrbitCamera(space, {.azimuthDegrees = 50, .zenithDegrees = 40, .radius = 300});
    orbit.slide(30, 40);
    EXPECT_NEAR(orbit.orbit().target.z, 0, 1e-12);
    EXPECT_NEAR(apart(old, orbit.orbit().target), 50, 1e-9) << name;
  }
}

}  // namespace
}  // namespace arete
