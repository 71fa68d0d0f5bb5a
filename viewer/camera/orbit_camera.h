// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "viewer/camera/camera_space.h"

namespace arete {

/// A camera on a sphere around a target that it looks at (Fornous 2003, A.1.2).
class OrbitCamera {
 public:
  struct Orbit {
    Vec3 target = {};           ///< metric
    double azimuthDegrees = 0;  ///< in which the camera looks: 0 = it stands south of the target
    double zenithDegrees = 60;  ///< of the camera seen from the target: 0 = straight above, 90 = level
    double radius = 1000;       ///< metres, > 0
  };
  /// `picture` gives field of view and size; its position and direction are ignored.
  OrbitCamera(const CameraSpace& space, const Orbit& orbit, const Camera& picture = {});

  /// The orbit of a camera around the point at a distance ahead of it; the picture does not change.
  /// Precondition: radius > 0.
  static OrbitCamera of(const CameraSpace& space, const Camera& camera, double radius);

  const Orbit& orbit() const { return orbit_; }
  Camera camera() const;

  /// Around the target, in degrees: the camera goes anticlockwise for `azimuth` > 0 and down for `zenith` >
  /// 0, from straight above to straight below.
  void turn(double azimuthDegrees, double zenithDegrees);
  /// Multiplies the radius; it stays within the limits. The height of a parallel picture grows with it.
  void zoom(double factor);
  /// Zooms so that `point` (metric) stays at its place in the picture.
  void zoomAbout(const Vec3& point, double factor);
  /// Moves camera and target in the plane of the picture, in metres at the target.
  void pan(double right, double up);
  /// Moves camera and target horizontally.
  void slide(double right, double ahead);

  /// Sets the limits of zoom(); the current radius stays. Precondition: 0 < least <= most.
  void limitRadius(double least, double most);

 private:
  CameraSpace space_;
  Orbit orbit_;
  Camera picture_;
  double leastRadius_ = 0.01, mostRadius_ = 1e9;
};

}  // namespace arete
