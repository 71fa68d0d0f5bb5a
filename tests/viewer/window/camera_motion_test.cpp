// SPDX-License-Identifier: GPL-3.0-or-later
// From mouse, keys and sticks to motion.
#include "viewer/window/camera_motion.h"

#include <gtest/gtest.h>
#include <cmath>

namespace arete {
namespace {

const MotionScale kFree{.mode = CameraMode::free, .metresPerSecond = 100};
const MotionScale kOrbit{.mode = CameraMode::orbit, .metresPerPixel = 2, .degreesPerPixel = 0.3};

TEST(CameraMotion, HandsThatDoNothingAskForNothing) {
  InputState still;
  still.seconds = 0.02;
  still.mouseMoved = {30, -12};
  EXPECT_TRUE(motionOf(still, kFree).isNone());
  EXPECT_TRUE(motionOf(still, kOrbit).isNone());
}

TEST(CameraMotion, AStickInItsDeadZoneAsksForNothingAndBeyondItStartsFromNothing) {
  InputState in;
  in.seconds = 0.02;
  in.gamepad.leftX = 0.1;
  in.gamepad.leftY = -0.14;
  EXPECT_TRUE(motionOf(in, kFree).isNone());
  in.gamepad.leftY = -0.151;
  EXPECT_NEAR(motionOf(in, kFree).speed.tangent, 0, 1);
  in.gamepad.leftY = -1;
  EXPECT_DOUBLE_EQ(motionOf(in, kFree).speed.tangent, 100);
}

TEST(CameraMotion, KeysAndSticksTogetherAreNoFasterThanEither) {
  InputState in;
  in.seconds = 0.02;
  in.ahead = 1;
  in.gamepad.leftY = -1;
  EXPECT_DOUBLE_EQ(motionOf(in, kFree).speed.tangent, 100);
}

TEST(CameraMotion, ShiftIsFasterAndAltSlower) {
  InputState in;
  in.right = 1;
  const double usual = motionOf(in, kFree).speed.binormal;
  in.isFast = true;
  EXPECT_DOUBLE_EQ(motionOf(in, kFree).speed.binormal, 5 * usual);
  in.isFast = false;
  in.isSlow = true;
  EXPECT_DOUBLE_EQ(motionOf(in, kFree).speed.binormal, 0.2 * usual);
}

TEST(CameraMotion, WheelNotchesUndoEachOther) {
  InputState in;
  in.wheel = 3;
  const CameraMotion there = motionOf(in, kOrbit), faster = motionOf(in, kFree);
  in.wheel = -3;
  EXPECT_NEAR(there.zoom * motionOf(in, kOrbit).zoom, 1, 1e-12);
  EXPECT_LT(there.zoom, 1);
  EXPECT_NEAR(faster.speedFactor * motionOf(in, kFree).speedFactor, 1, 1e-12);
}

TEST(CameraMotion, EachButtonDragsWhatItIsFor) {
  InputState in;
  in.mouseMoved = {10, 5};
  in.leftButton = true;
  EXPECT_TRUE(motionOf(in, kFree).isNone()) << "left picks";
  EXPECT_DOUBLE_EQ(motionOf(in, kOrbit).turnRight, 3);
  EXPECT_DOUBLE_EQ(motionOf(in, kOrbit).turnUp, -1.5);
  in.leftButton = false;
  in.rightButton = true;
  EXPECT_GT(motionOf(in, kFree).turnRight, 0);
  EXPECT_LT(motionOf(in, kFree).turnUp, 0);
  EXPECT_DOUBLE_EQ(motionOf(in, kOrbit).slideRight, -20);
  EXPECT_DOUBLE_EQ(motionOf(in, kOrbit).slideAhead, 10);
}

}  // namespace
}  // namespace arete
