// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/camera/camera_space.h"

#include <gtest/gtest.h>

#include "viewer/camera_models.h"

namespace arete {
namespace {

TEST(CameraSpace, AgreesWithTheViewOnEveryGrid) {
  for (const auto& [name, model] : test::cameraModels()) {
    const CameraSpace space(model);
    Random random(1);
    for (int i = 0; i < 200; ++i) {
      const Camera camera = test::randomCamera(random, model);
      const auto view = viewOf(camera, model);
      ASSERT_TRUE(view);
      ASSERT_LT(test::apart(space.position(camera), view->eye), 1e-6) << name << ", camera " << i;
      ASSERT_LT(test::apart(space.forward(lookOf(camera)), view->forward), 1e-7) << name << ", camera " << i;
      ASSERT_LT(test::apart(space.up(lookOf(camera)), view->up), 1e-7) << name << ", camera " << i;
    }
  }
}

TEST(CameraSpace, ComesBackFromPositionsAndDirections) {
  for (const auto& [name, model] : test::cameraModels()) {
    const CameraSpace space(model);
    Random random(2);
    for (int i = 0; i < 200; ++i) {
      const Camera camera = test::randomCamera(random, model);
      const Vec3 p = space.position(camera);
      const Camera back = space.at(camera, p);
      ASSERT_LT(test::apart(space.position(back), p), 1e-7) << name;
      ASSERT_NEAR(back.height, camera.height, 1e-9) << name;
      const Vec3 f = space.forward(lookOf(camera));
      const Look look = space.lookAlong({17 * f.x, 17 * f.y, 17 * f.z}, camera.azimuthDegrees);
      ASSERT_NEAR(look.pitchDegrees, camera.pitchDegrees, 1e-6) << name;
      if (std::abs(camera.pitchDegrees) < 89) {
        ASSERT_LT(test::turned(look.azimuthDegrees, camera.azimuthDegrees), 1e-9) << name;
      }
    }
    EXPECT_EQ(space.lookAlong({0, 0, -3}, 123).azimuthDegrees, 123);
    EXPECT_EQ(space.lookAlong({0, 0, -3}, 123).pitchDegrees, -90);
  }
}

TEST(CameraSpace, HasRightOnTheRightOfTheMap) {
  for (const auto& [name, model] : test::cameraModels()) {
    const CameraSpace space(model);
    for (const double azimuth : {0.0, 77.0, 180.0, 300.0}) {
      const Vec3 right = space.right(azimuth);
      EXPECT_GT(dot(right, space.forward({azimuth + 90, 0})), 0.5) << name;
      EXPECT_NEAR(dot(right, space.forward({azimuth, 30})), 0, 1e-12) << name;
      EXPECT_NEAR(dot(right, right), 1, 1e-12) << name;
    }
  }
}

TEST(CameraSpace, CountsMetresOnTheGroundInDegreesAndFeet) {
  for (const auto& [name, model] : test::cameraModels()) {
    const CameraSpace space(model);
    const Vec2 middle = model.toSource({23, 15});
    if (name == "geographic") {
      // A thousandth of a degree at 60 degrees north: 55.8 m east, 111.4 m north.
      const Vec3 here = space.position(middle, 0);
      EXPECT_NEAR(test::apart(here, space.position({middle.x + 0.001, middle.y}, 0)), 55.8, 0.1);
      EXPECT_NEAR(test::apart(here, space.position({middle.x, middle.y + 0.001}, 0)), 111.4, 0.1);
    }
    if (name == "in feet") {
      EXPECT_NEAR(space.position(middle, 1000).z - space.position(middle, 0).z, 304.8, 1e-9);
    }
  }
}

TEST(CameraSpace, WrapsAzimuths) {
  EXPECT_EQ(wrappedAzimuth(-90), 270);
  EXPECT_EQ(wrappedAzimuth(720), 0);
  EXPECT_EQ(wrappedAzimuth(359.5), 359.5);
  EXPECT_LT(wrappedAzimuth(-1e-20), 360);
  EXPECT_GE(wrappedAzimuth(-1e-20), 0);
}

}  // namespace
}  // namespace arete
