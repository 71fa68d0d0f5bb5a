// SPDX-License-Identifier: GPL-3.0-or-later
// The camera that hands move, above a terrain.
#include "viewer/window/camera_rig.h"

#include <gtest/gtest.h>
#include <cmath>
#include <optional>

#include "viewer/camera_models.h"
#include "viewer/scene/terrain_subject.h"
#include "viewer/window/camera_motion.h"

namespace arete {
namespace {

using test::apart;
using test::cameraModels;

struct Flown {
  const TerrainModel& model;
  TerrainSubject subject{model};
  CameraRig rig;
  explicit Flown(const TerrainModel& m) : model(m), rig(subject, subject.home(HomeView::overview, {}, {})) {
    rig.setPicture(800, 600);
  }
  Vec3 eye() const { return subject.space().position(rig.camera()); }
};

TEST(CameraRig, DraggingInAnOrbitTurnsAboutWhatIsInTheMiddle) {
  for (const test::CameraModel& m : cameraModels()) {
    SCOPED_TRACE(m.name);
    Flown f(m.model);
    const auto hit = f.subject.pick(f.rig.camera(), {400, 300});
    InputState in;
    in.seconds = 0.02;
    in.leftButton = true;
    in.mouseMoved = {50, -10};
    f.rig.setFloorMetres(0);
    EXPECT_TRUE(f.rig.step(in));
    if (hit) {
      const auto seen = pixelOf(f.subject, f.rig.camera(), hit->metric);
      ASSERT_TRUE(seen);
      EXPECT_NEAR(seen->x, 400, 1e-4);
      EXPECT_NEAR(seen->y, 300, 1e-4);
    }
    EXPECT_NEAR(std::abs(std::remainder(f.rig.camera().azimuthDegrees - 15, 360)), 0, 1e-9);
  }
}

TEST(CameraRig, TheWheelInAnOrbitKeepsWhatIsUnderTheMouse) {
  for (const test::CameraModel& m : cameraModels()) {
    SCOPED_TRACE(m.name);
    Flown f(m.model);
    f.rig.setFloorMetres(0);
    // Not everywhere is there terrain.
    Vec2 mouse;
    std::optional<Pick> under;
    for (int i = 0; i < 400 && !under; ++i)
      under =
          f.subject.pick(f.rig.camera(), mouse = {double(100 + 37 * i % 600), double(100 + 53 * i % 400)});
    ASSERT_TRUE(under);
    InputState in;
    in.seconds = 0.02;
    in.wheel = 2;
    in.mouse = mouse;
    EXPECT_TRUE(f.rig.step(in));
    const auto seen = pixelOf(f.subject, f.rig.camera(), under->metric);
    ASSERT_TRUE(seen);
    EXPECT_NEAR(seen->x, mouse.x, 1e-3);
    EXPECT_NEAR(seen->y, mouse.y, 1e-3);
    EXPECT_LT(apart(f.eye(), under->metric), under->metres);
  }
}

TEST(CameraRig, AnOrbitStaysCentredUnderExaggeration) {
  Flown f(cameraModels()[0].model);
  f.rig.setFloorMetres(0);
  const auto before = f.subject.pick(f.rig.camera(), {400, 300});
  f.rig.setStretch(3);
  InputState in;
  in.seconds = 0.02;
  in.leftButton = true;
  in.mouseMoved = {50, 20};
  f.rig.step(in);
  const auto seen = pixelOf(f.subject, f.rig.camera(), before->metric, {.stretch = 3});
  ASSERT_TRUE(seen);
  EXPECT_NEAR(seen->x, 400, 1e-4);
  EXPECT_NEAR(seen->y, 300, 1e-4);
}

TEST(CameraRig, FlyingAheadGoesWhereThePictureLooksWhateverTheFrames) {
  for (const test::CameraModel& m : cameraModels())
    for (const int frames : {1, 7, 60}) {
      SCOPED_TRACE(m.name);
      Flown f(m.model);
      f.rig.setMode(CameraMode::free);
      f.rig.setFloorMetres(0);
      f.rig.setMetresPerSecond(10);
      const Vec3 from = f.eye(), forward = f.subject.space().forward(lookOf(f.rig.camera()));
      InputState in;
      in.ahead = 1;
      in.seconds = 2.0 / frames;
      for (int i = 0; i < frames; ++i) f.rig.step(in);
      // Two seconds at 10 m/s, less what the inertia takes.
      const Vec3 to = f.eye();
      const double way = apart(from, to);
      EXPECT_NEAR(way, 20 - 10 * 0.15 * (1 - std::exp(-2 / 0.15)), 1e-6);
      EXPECT_NEAR(
          way, (to.x - from.x) * forward.x + (to.y - from.y) * forward.y + (to.z - from.z) * forward.z, 1e-6);
    }
}

TEST(CameraRig, NothingTakesTheCameraBelowTheFloorWhetherItIsTheUsualOneOrAnother) {
  for (const std::optional<double> stated : {std::optional<double>(), std::optional<double>(5)}) {
    Flown f(cameraModels()[0].model);
    if (stated) f.rig.setFloorMetres(*stated);
    const double floor = stated.value_or(2);
    EXPECT_EQ(f.rig.floorMetres(), floor);
    Random random(11);
    for (const CameraMode mode : {CameraMode::orbit, CameraMode::free}) {
      f.rig.home(HomeView::overview);
      f.rig.setMode(mode);
      for (int i = 0; i < 300; ++i) {
        InputState in;
        in.seconds = 0.05;
        in.ahead = random.between(-1, 1);
        in.up = random.between(-1, 0.2);
        in.turnRight = random.between(-1, 1);
        in.leftButton = in.rightButton = true;
        in.mouseMoved = {random.between(-30, 30), random.between(-30, 30)};
        in.mouse = {random.between(0, 800), random.between(0, 600)};
        in.wheel = random.between(-1, 1);
        f.rig.step(in);
        const auto above = f.rig.metresAboveGround();
        ASSERT_GE(above.value_or(floor), floor - 1e-6) << "frame " << i;
      }
    }
  }
}

TEST(CameraRig, ChangingTheModeKeepsThePicture) {
  for (const test::CameraModel& m : cameraModels()) {
    Flown f(m.model);
    const Camera before = f.rig.camera();
    for (int i = 0; i < 3; ++i) {
      f.rig.setMode(CameraMode::free);
      f.rig.setMode(CameraMode::orbit);
    }
    EXPECT_EQ(before.height, f.rig.camera().height);
    EXPECT_EQ(before.azimuthDegrees, f.rig.camera().azimuthDegrees);
    EXPECT_EQ(before.pitchDegrees, f.rig.camera().pitchDegrees);
  }
}

}  // namespace
}  // namespace arete
