// SPDX-License-Identifier: GPL-3.0-or-later
//
// Each frame: convert the input to a motion, move the orbit or the free camera, then apply terrain following
// and the floor.
#include "viewer/window/camera_rig.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace arete {

CameraRig::CameraRig(const Subject& subject, const Camera& start)
    : subject_(subject),
      space_(subject.space()),
      camera_(start),
      orbit_(space_, {}, start),
      free_(space_, start),
      metresPerSecond_(subject.box().diagonal() / 40) {
  setFloorMetres(subject.heights() ? floorMetres_ : 0);
}

Camera CameraRig::shown(Camera camera) const {
  Vec3 p = space_.position(camera);
  p.z *= stretch_;
  camera.height = space_.height(p);
  return camera;
}

Camera CameraRig::asIs(Camera camera) const {
  Vec3 p = space_.position(camera);
  p.z /= stretch_;
  camera.height = space_.height(p);
  return camera;
}

/// Of the camera at hand: as far as the model in the middle of its picture, or, of what lies ahead, the place
/// nearest to the middle of all.
double CameraRig::reach() const {
  const Vec2 middle{camera_.widthPixels / 2, camera_.heightPixels / 2};
  // A surface turns about its own middle, not about the part of it that is in front.
  const auto hit = subject_.heights() ? subject_.pick(camera_, middle, {.stretch = stretch_}) : std::nullopt;
  Vec3 target = hit ? hit->metric : subject_.box().centre(), eye = space_.position(camera_);
  target.z *= stretch_;
  eye.z *= stretch_;
  if (subject_.heights()) return std::max(norm(target - eye), 1e-3);
  return std::max(dot(target - eye, space_.forward(lookOf(camera_))), subject_.leastRadius());
}

Camera CameraRig::aboveFloor(const Camera& camera) {
  // A parallel picture is the same wherever along its axis the eye stands, and raising it would shift it.
  if (camera.parallelHeight > 0) return camera;
  return ground_ && floorMetres_ > 0 ? ground_->aboveFloor(camera) : camera;
}

/// Both cameras and the following of the terrain begin anew from a place, so that the next input continues
/// from it in either mode.
void CameraRig::enter(const Camera& camera) {
  camera_ = camera;
  camera_.azimuthDegrees = wrappedAzimuth(camera.azimuthDegrees);
  const Camera there = shown(camera_);
  orbit_ = OrbitCamera::of(space_, there, reach());
  orbit_.limitRadius(std::max(floorMetres_, subject_.leastRadius()), 100 * subject_.box().diagonal());
  free_.place(there);
  free_.stop();
  if (follows_) ground_->begin(camera_);
}

void CameraRig::place(const Camera& camera) {
  Camera there = camera;
  there.widthPixels = camera_.widthPixels;
  there.heightPixels = camera_.heightPixels;
  enter(there);
}

void CameraRig::setMode(CameraMode mode) {
  mode_ = mode;
  if (mode == CameraMode::orbit) follows_ = false;
  enter(camera_);
}

void CameraRig::home(HomeView view, bool isCurved, const CoveredEdges& covered) {
  mode_ = CameraMode::orbit;
  follows_ = false;
  enter(subject_.home(view, camera_, {.stretch = stretch_, .isCurved = isCurved}, covered));
}

// The target stays in the middle of the picture, at the stated distance or the present one.
void CameraRig::lookAt(const Vec3& metric, double metres) {
  const double radius = metres > 0 ? metres : orbit_.orbit().radius;
  const Vec3 f = space_.forward(lookOf(camera_)), target{metric.x, metric.y, metric.z * stretch_};
  enter(aboveFloor(asIs(space_.at(camera_, target - radius * f))));
}

// A change of the picture or the field of view changes what lies in its middle, so the orbit is found again.
void CameraRig::setPicture(double widthPixels, double heightPixels) {
  if (camera_.widthPixels == widthPixels && camera_.heightPixels == heightPixels) return;
  camera_.widthPixels = widthPixels;
  camera_.heightPixels = heightPixels;
  enter(camera_);
}

void CameraRig::setFieldOfView(double degrees) {
  camera_.verticalFieldOfViewDegrees = degrees;
  enter(camera_);
}

void CameraRig::setParallel(bool isParallel) {
  if (isParallel == (camera_.parallelHeight > 0)) return;
  const double slope = 2 * std::tan(camera_.verticalFieldOfViewDegrees * std::numbers::pi / 360);
  if (isParallel) {
    setParallelHeight(slope * orbit_.orbit().radius);
    return;
  }
  // The eye goes to where perspective has the picture as high at the place that is orbited.
  OrbitCamera there = orbit_;
  there.zoom(camera_.parallelHeight / slope / orbit_.orbit().radius);
  Camera camera = asIs(there.camera());
  camera.parallelHeight = 0;
  enter(aboveFloor(camera));
}

void CameraRig::setParallelHeight(double metres) {
  camera_.parallelHeight = metres;
  enter(camera_);
}

void CameraRig::setStretch(double stretch) {
  if (stretch == stretch_) return;
  // What is orbited stays in the middle, at its own height.
  const double radius = orbit_.orbit().radius;
  Vec3 target = orbit_.orbit().target;
  target.z /= stretch_;
  stretch_ = stretch;
  if (mode_ == CameraMode::orbit)
    lookAt(target, radius);
  else
    enter(camera_);
}

void CameraRig::follow(bool isOn) {
  if (!ground_) return;
  if (isOn && mode_ != CameraMode::free) setMode(CameraMode::free);
  follows_ = isOn;
  if (isOn) ground_->begin(camera_);
}

void CameraRig::setFloorMetres(double metres) {
  floorMetres_ = metres;
  if (const GroundHeights* heights = subject_.heights())
    ground_.emplace(*heights, space_, GroundFollowing::Options{.floorMetres = metres});
  enter(camera_);
}

void CameraRig::setMetresPerSecond(double speed) {
  const double diagonal = subject_.box().diagonal();
  metresPerSecond_ = std::clamp(speed, 1e-6 * diagonal, 10 * diagonal);
}

std::optional<double> CameraRig::metresAboveGround() const {
  const auto ground = subject_.heights() ? subject_.heights()->at(camera_.xy) : std::nullopt;
  if (!ground) return std::nullopt;
  return (camera_.height - ground->height) * space_.metresPerHeight();
}

bool CameraRig::step(const InputState& input) {
  const Vec3 before = space_.position(camera_);
  const double slope = std::tan(camera_.verticalFieldOfViewDegrees * std::numbers::pi / 360);
  const CameraMotion motion = motionOf(
      input,
      {.mode = mode_,
       .metresPerSecond = metresPerSecond_,
       .metresPerPixel =
           (camera_.parallelHeight > 0 ? camera_.parallelHeight : 2 * orbit_.orbit().radius * slope) /
           camera_.heightPixels,
       .degreesPerPixel =
           mode_ == CameraMode::orbit ? 0.3 : camera_.verticalFieldOfViewDegrees / camera_.heightPixels * 2});
  Camera there;
  if (mode_ == CameraMode::free) {
    free_.turn(motion.turnRight, motion.turnUp);
    free_.fly(motion.speed, input.seconds);
    setMetresPerSecond(metresPerSecond_ * motion.speedFactor);
    there = asIs(free_.camera());
    if (follows_) {
      // Climbing changes the height that is kept.
      if (motion.speed.climb != 0)
        ground_->keep(ground_->keptMetres() + motion.speed.climb * input.seconds / stretch_);
      there = ground_->follow(there, input.seconds);
    } else {
      there = aboveFloor(there);
    }
    free_.place(shown(there));
  } else {
    if (motion.isNone()) {
      lastSpeed_ = 0;
      return false;
    }
    orbit_.turn(motion.turnRight, motion.turnUp);
    if (ground_)
      orbit_.slide(motion.slideRight, motion.slideAhead);
    else
      orbit_.pan(motion.slideRight, motion.slideAhead);
    if (motion.zoom != 1) {
      const auto under =
          input.wheel != 0 ? subject_.pick(camera_, input.mouse, {.stretch = stretch_}) : std::nullopt;
      if (under)
        orbit_.zoomAbout({under->metric.x, under->metric.y, under->metric.z * stretch_}, motion.zoom);
      else
        orbit_.zoom(motion.zoom);
    }
    there = asIs(orbit_.camera());
    // The orbit goes on where it would be; only what is seen stays above the floor.
    there = aboveFloor(there);
  }
  there.widthPixels = camera_.widthPixels;
  there.heightPixels = camera_.heightPixels;
  camera_ = there;
  lastSpeed_ = input.seconds > 0 ? norm(space_.position(camera_) - before) / input.seconds : 0;
  return !motion.isNone();
}

}  // namespace arete
