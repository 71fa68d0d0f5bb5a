// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "viewer/camera/free_camera.h"
#include "viewer/window/input_state.h"

namespace arete {

enum class CameraMode {
  orbit,  ///< around a place of the terrain
  free,   ///< through the air
};

/// The current scale of pixels and keys.
struct MotionScale {
  CameraMode mode = CameraMode::orbit;
  double metresPerSecond = 100;  ///< of free flight
  double metresPerPixel = 1;     ///< at the place that is orbited
  double degreesPerPixel = 0.2;
  double degreesPerSecond = 60;  ///< of the arrows and of a stick at its end
  double deadZone = 0.15;        ///< of a stick
};

/// The motion that an input means for the camera.
struct CameraMotion {
  CameraStep speed = {};                  ///< metres per second; free flight only
  double turnRight = 0, turnUp = 0;       ///< degrees: of the camera, or of the orbit
  double zoom = 1;                        ///< factor on the radius of the orbit
  double slideRight = 0, slideAhead = 0;  ///< metres by which the orbit moves over the map
  double speedFactor = 1;                 ///< of the speed of free flight from now on

  bool isNone() const;
};

/// Converts an input to a motion (docs/topics/viewer.md).
CameraMotion motionOf(const InputState& input, const MotionScale& scale);

}  // namespace arete
