// SPDX-License-Identifier: GPL-3.0-or-later
//
// In an orbit, dragging moves the terrain with the mouse, so the camera goes the other way round. In free
// flight, dragging turns the camera. Both have the same signs, since an orbit turns about a place ahead.
#include "viewer/window/camera_motion.h"

#include <algorithm>
#include <cmath>

namespace arete {
namespace {

constexpr double kFast = 5, kSlow = 0.2;
constexpr double kZoomPerNotch = 0.85, kSpeedPerNotch = 1.25, kZoomPerSecond = 3;

/// A stick at rest is never quite at 0; outside of the dead zone it starts from 0.
double stick(double value, double deadZone) {
  const double beyond = std::abs(value) - deadZone;
  return beyond <= 0 ? 0 : std::copysign(std::min(beyond / (1 - deadZone), 1.0), value);
}

double oneAtMost(double value) {
  return std::clamp(value, -1.0, 1.0);
}

}  // namespace

bool CameraMotion::isNone() const {
  return speed.tangent == 0 && speed.binormal == 0 && speed.normal == 0 && speed.climb == 0 &&
         turnRight == 0 && turnUp == 0 && zoom == 1 && slideRight == 0 && slideAhead == 0 && speedFactor == 1;
}

CameraMotion motionOf(const InputState& in, const MotionScale& scale) {
  const InputState::Gamepad& pad = in.gamepad;
  const double factor = (in.isFast || pad.isFast ? kFast : 1) * (in.isSlow ? kSlow : 1);
  const double ahead = oneAtMost(in.ahead - stick(pad.leftY, scale.deadZone));
  const double right = oneAtMost(in.right + stick(pad.leftX, scale.deadZone));
  const double up = oneAtMost(in.up + pad.rightTrigger - pad.leftTrigger);
  const double turn = scale.degreesPerSecond * in.seconds;

  CameraMotion motion;
  motion.turnRight = turn * oneAtMost(in.turnRight + stick(pad.rightX, scale.deadZone));
  motion.turnUp = turn * oneAtMost(in.turnUp - stick(pad.rightY, scale.deadZone));
  const bool turns = scale.mode == CameraMode::orbit ? in.leftButton : in.rightButton;
  if (turns) {
    motion.turnRight += scale.degreesPerPixel * in.mouseMoved.x;
    motion.turnUp -= scale.degreesPerPixel * in.mouseMoved.y;
  }
  if (scale.mode == CameraMode::free) {
    const double metres = scale.metresPerSecond * factor;
    motion.speed = {.tangent = metres * ahead, .binormal = metres * right, .normal = 0, .climb = metres * up};
    motion.speedFactor = std::pow(kSpeedPerNotch, in.wheel);
    return motion;
  }
  // As far in a second as the picture is wide, about.
  const double metres = 800 * scale.metresPerPixel * factor * in.seconds;
  motion.slideRight = metres * right;
  motion.slideAhead = metres * ahead;
  if (!in.leftButton && (in.rightButton || in.middleButton)) {
    motion.slideRight -= scale.metresPerPixel * in.mouseMoved.x;
    motion.slideAhead += scale.metresPerPixel * in.mouseMoved.y;
  }
  motion.zoom = std::pow(kZoomPerNotch, in.wheel) * std::pow(kZoomPerSecond, -up * in.seconds);
  return motion;
}

}  // namespace arete
