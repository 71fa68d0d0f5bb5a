// SPDX-License-Identifier: GPL-3.0-or-later
//
// The camera is a function of the orbit: its position is the target minus the radius times the forward
// direction.
#include "viewer/camera/orbit_camera.h"

#include <algorithm>
#include <cmath>

namespace arete {
namespace {

Vec3 along(const Vec3& from, const Vec3& direction, double length) {
  return {from.x + length * direction.x, from.y + length * direction.y, from.z + length * direction.z};
}

Look lookOn(const OrbitCamera::Orbit& orbit) {
  return {orbit.azimuthDegrees, orbit.zenithDegrees - 90};
}

}  // namespace

OrbitCamera::OrbitCamera(const CameraSpace& space, const Orbit& orbit, const Camera& picture)
    : space_(space), orbit_(orbit), picture_(picture) {}

OrbitCamera OrbitCamera::of(const CameraSpace& space, const Camera& camera, double radius) {
  const Vec3 target = along(space.position(camera), space.forward(lookOf(camera)), radius);
  return {space, {target, wrappedAzimuth(camera.azimuthDegrees), camera.pitchDegrees + 90, radius}, camera};
}

Camera OrbitCamera::camera() const {
  const Look look = lookOn(orbit_);
  Camera camera = space_.at(picture_, along(orbit_.target, space_.forward(look), -orbit_.radius));
  camera.azimuthDegrees = look.azimuthDegrees;
  camera.pitchDegrees = look.pitchDegrees;
  return camera;
}

void OrbitCamera::turn(double azimuthDegrees, double zenithDegrees) {
  orbit_.azimuthDegrees = wrappedAzimuth(orbit_.azimuthDegrees + azimuthDegrees);
  orbit_.zenithDegrees = std::clamp(orbit_.zenithDegrees + zenithDegrees, 0.0, 180.0);
}

void OrbitCamera::zoom(double factor) {
  const double before = orbit_.radius;
  orbit_.radius = std::clamp(before * factor, leastRadius_, mostRadius_);
  picture_.parallelHeight *= orbit_.radius / before;
}

void OrbitCamera::zoomAbout(const Vec3& point, double factor) {
  const double before = orbit_.radius;
  zoom(factor);
  // Camera and target go the same part of their ways to the point, so directions to it stay.
  const Vec3 t = orbit_.target;
  orbit_.target = along(t, {point.x - t.x, point.y - t.y, point.z - t.z}, 1 - orbit_.radius / before);
}

void OrbitCamera::pan(double right, double up) {
  orbit_.target = along(orbit_.target, space_.right(orbit_.azimuthDegrees), right);
  orbit_.target = along(orbit_.target, space_.up(lookOn(orbit_)), up);
}

void OrbitCamera::slide(double right, double ahead) {
  orbit_.target = along(orbit_.target, space_.right(orbit_.azimuthDegrees), right);
  orbit_.target = along(orbit_.target, space_.forward({orbit_.azimuthDegrees, 0}), ahead);
}

void OrbitCamera::limitRadius(double least, double most) {
  leastRadius_ = least;
  mostRadius_ = most;
}

}  // namespace arete
