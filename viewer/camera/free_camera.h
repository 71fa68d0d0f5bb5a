// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "viewer/camera/camera_space.h"

namespace arete {

/// A displacement in the directions of a camera, or a speed: metres, or metres per second (source units
/// without a CRS).
struct CameraStep {
  double tangent = 0;   ///< ahead, where the camera looks
  double binormal = 0;  ///< to the right, always level
  double normal = 0;    ///< up in the picture
  double climb = 0;     ///< straight up
};

/// Free flight: the camera turns on the spot and moves in its own directions (Fornous 2003, A.1.3).
class FreeCamera {
 public:
  FreeCamera(const CameraSpace& space, const Camera& camera);

  const Camera& camera() const { return camera_; }
  /// Sets the camera, as terrain following, a key or a flight does. The speed stays.
  void place(const Camera& camera);

  /// To the right and up, in degrees. The pitch stops at straight up and straight down.
  void turn(double rightDegrees, double upDegrees);
  void move(const CameraStep& metres);

  /// Advances by some time. The speed approaches the wanted one within about three `inertiaSeconds`; the path
  /// does not depend on how the time is divided into frames. Precondition: seconds >= 0.
  void fly(const CameraStep& wantedSpeed, double seconds, double inertiaSeconds = 0.15);
  const CameraStep& speed() const { return speed_; }
  /// Sets the speed to zero.
  void stop() { speed_ = {}; }

 private:
  CameraSpace space_;
  Camera camera_;
  CameraStep speed_;
};

}  // namespace arete
