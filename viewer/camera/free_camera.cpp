// SPDX-License-Identifier: GPL-3.0-or-later
//
// Inertia: the speed v follows v' = (w - v) / T towards the wanted speed w. Over a time t it becomes
// w + (v - w) exp(-t / T), and the way is its integral, w t + (v - w) T (1 - exp(-t / T)): both are taken in
// closed form, so that frames of any length add up to the same.
#include "viewer/camera/free_camera.h"

#include <algorithm>
#include <cmath>

namespace arete {

FreeCamera::FreeCamera(const CameraSpace& space, const Camera& camera) : space_(space) {
  place(camera);
}

void FreeCamera::place(const Camera& camera) {
  camera_ = camera;
  camera_.azimuthDegrees = wrappedAzimuth(camera.azimuthDegrees);
}

void FreeCamera::turn(double rightDegrees, double upDegrees) {
  camera_.azimuthDegrees = wrappedAzimuth(camera_.azimuthDegrees + rightDegrees);
  camera_.pitchDegrees = std::clamp(camera_.pitchDegrees + upDegrees, -90.0, 90.0);
}

void FreeCamera::move(const CameraStep& metres) {
  const Look look = lookOf(camera_);
  const Vec3 t = space_.forward(look), b = space_.right(look.azimuthDegrees), n = space_.up(look);
  const Vec3 here = space_.position(camera_);
  camera_ = space_.at(camera_, {here.x + metres.tangent * t.x + metres.binormal * b.x + metres.normal * n.x,
                                here.y + metres.tangent * t.y + metres.binormal * b.y + metres.normal * n.y,
                                here.z + metres.tangent * t.z + metres.normal * n.z + metres.climb});
}

void FreeCamera::fly(const CameraStep& wantedSpeed, double seconds, double inertiaSeconds) {
  const double left = inertiaSeconds > 0 ? std::exp(-seconds / inertiaSeconds) : 0;
  CameraStep way;
  for (double CameraStep::*part :
       {&CameraStep::tangent, &CameraStep::binormal, &CameraStep::normal, &CameraStep::climb}) {
    const double wanted = wantedSpeed.*part, excess = speed_.*part - wanted;
    way.*part = wanted * seconds + excess * inertiaSeconds * (1 - left);
    speed_.*part = wanted + excess * left;
    // What is left of a speed long gone does not keep a picture from standing still.
    if (wanted == 0 && std::abs(speed_.*part) < 1e-9) speed_.*part = 0;
  }
  if (way.tangent != 0 || way.binormal != 0 || way.normal != 0 || way.climb != 0) move(way);
}

}  // namespace arete
