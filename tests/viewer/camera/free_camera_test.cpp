// SPDX-License-Identifier: GPL-3.0-or-later
// Free flight: turns, steps, inertia.
#include "viewer/camera/free_camera.h"

#include <gtest/gtest.h>
#include <cmath>

#include "viewer/camera_models.h"

namespace arete {
namespace {

using test::apart;
using test::inPicture;

TEST(FreeCamera, MovesByMetresInItsOwnDirections) {
  for (const auto& [name, model] : test::cameraModels()) {
    const CameraSpace space(model);
    Random random(6);
    for (int i = 0; i < 50; ++i) {
      SCOPED_TRACE(name + ", seed 6, camera " + std::to_string(i));
      const Camera start = test::randomCamera(random, model);
      const Vec3 from = space.position(start);
      FreeCamera camera(space, start);
      camera.move({.tangent = 100});
      const auto seen = inPicture(start, space.position(camera.camera()), model);
      ASSERT_TRUE(seen);
      EXPECT_NEAR(seen->x, 0, 1e-5);
      EXPECT_NEAR(seen->y, 0, 1e-5);
      EXPECT_NEAR(apart(from, space.position(camera.camera())), 100, 1e-5);
      camera.move({.tangent = -100});
      EXPECT_LT(apart(from, space.position(camera.camera())), 1e-5);

      camera.move({.binormal = 100});
      EXPECT_NEAR(space.position(camera.camera()).z, from.z, 1e-9) << "the binormal is level";
      camera.place(start);
      camera.move({.normal = 30, .climb = 7});
      camera.move({.normal = -30});
      EXPECT_NEAR(space.position(camera.camera()).z, from.z + 7, 1e-6);
    }
  }
}

TEST(FreeCamera, MovesRightWhenTheMapSaysRight) {
  for (const auto& [name, model] : test::cameraModels()) {
    const CameraSpace space(model);
    FreeCamera camera(space, {.xy = model.toSource({20, 12})});
    camera.move({.binormal = 10});
    EXPECT_GT(camera.camera().xy.x, model.toSource({20, 12}).x) << name << ": looking north, right is east";
  }
}

TEST(FreeCamera, StopsTurningStraightUpAndStraightDown) {
  const auto& model = test::cameraModels()[0].model;
  FreeCamera camera(CameraSpace(model), {.azimuthDegrees = -30});
  EXPECT_EQ(camera.camera().azimuthDegrees, 330);
  camera.turn(60, 500);
  EXPECT_NEAR(camera.camera().azimuthDegrees, 30, 1e-12);
  EXPECT_EQ(camera.camera().pitchDegrees, 90);
  camera.turn(0, -500);
  EXPECT_EQ(camera.camera().pitchDegrees, -90);
  EXPECT_TRUE(viewOf(camera.camera(), model));
}

TEST(FreeCamera, FliesTheSameWayHoweverTheTimeIsCutIntoFrames) {
  const auto& model = test::cameraModels()[1].model;
  const CameraSpace space(model);
  FreeCamera oneFrame(space, {.xy = model.toSource({20, 12}), .azimuthDegrees = 33, .pitchDegrees = -20});
  FreeCamera manyFrames = oneFrame;
  oneFrame.fly({.tangent = 150, .binormal = -20}, 1.5);
  Random random(7);
  double left = 1.5;
  while (left > 0) {
    const double frame = std::min(left, random.between(0, 0.05));
    manyFrames.fly({.tangent = 150, .binormal = -20}, frame);
    left -= frame;
  }
  EXPECT_LT(apart(space.position(oneFrame.camera()), space.position(manyFrames.camera())), 1e-5) << "seed 7";
  EXPECT_NEAR(oneFrame.speed().tangent, manyFrames.speed().tangent, 1e-9);
  EXPECT_NEAR(oneFrame.speed().tangent, 150, 0.01);
  for (int i = 0; i < 300; ++i) manyFrames.fly({}, 1.0 / 60);
  const Camera still = manyFrames.camera();
  manyFrames.fly({}, 1);
  EXPECT_EQ(manyFrames.camera().xy, still.xy) << "it comes to rest";
}

}  // namespace
}  // namespace arete
