// SPDX-License-Identifier: GPL-3.0-or-later
//
// Each frame: convert the input to a motion, move the orbit or the free camera, then apply terrain following
// and the floor.
#include "viewer/window/camera_rig.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "viewer/scene/curved_home_view.h"

namespace arete {
namespace {

double distance(const Vec3& a, const Vec3& b) {
  return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

}  // namespace

CameraRig::CameraRig(const TerrainPicker& picker, const GroundHeights& heights, const Camera& start)
    : picker_(picker),
      heights_(heights),
      space_(picker.space()),
      camera_(start),
      orbit_(space_, {}, start),
      free_(space_, start),
      ground_(std::in_place, heights, space_, GroundFollowing::Options{.floorMetres = floorMetres_}),
      metresPerSecond_(picker.box().diagonal() / 40) {
  enter(start);
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

/// Of the camera at hand: as far as the terrain in the middle of its picture, or the middle of all.
double CameraRig::reach() const {
  const auto hit = picker_.at(camera_, {camera_.widthPixels / 2, camera_.heightPixels / 2}, stretch_);
  Vec3 target = hit ? hit->metric : picker_.box().centre(), eye = space_.position(camera_);
  target.z *= stretch_;
  eye.z *= stretch_;
  return std::max(distance(eye, target), 1e-3);
}

/// Both cameras and the following of the terrain begin anew from a place, so that the next input continues
/// from it in either mode.
void CameraRig::enter(const Camera& camera) {
  camera_ = camera;
  camera_.azimuthDegrees = wrappedAzimuth(camera.azimuthDegrees);
  const Camera there = shown(camera_);
  orbit_ = OrbitCamera::of(space_, there, reach());
  orbit_.limitRadius(std::max(floorMetres_, 0.5), 100 * picker_.box().diagonal());
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

void CameraRig::home(HomeView view, const CurvedGround* ground) {
  mode_ = CameraMode::orbit;
  follows_ = false;
  enter(ground ? curvedHomeCamera(view, *ground, space_, picker_.box(), camera_, stretch_)
               : homeCamera(view, space_, picker_.box(), camera_, stretch_));
}

// The target stays in the middle of the picture, at the stated distance or the present one.
void CameraRig::lookAt(const Vec3& metric, double metres) {
  const double radius = metres > 0 ? metres : orbit_.orbit().radius;
  const Vec3 f = space_.forward(lookOf(camera_)), target{metric.x, metric.y, metric.z * stretch_};
  const Camera there =
      asIs(space_.at(camera_, {target.x - radius * f.x, target.y - radius * f.y, target.z - radius * f.z}));
  enter(floorMetres_ > 0 ? ground_->aboveFloor(there) : there);
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
  if (isOn && mode_ != CameraMode::free) setMode(CameraMode::free);
  follows_ = isOn;
  if (isOn) ground_->begin(camera_);
}

void CameraRig::setFloorMetres(double metres) {
  floorMetres_ = metres;
  ground_.emplace(heights_, space_, GroundFollowing::Options{.floorMetres = metres});
  enter(camera_);
}

void CameraRig::setMetresPerSecond(double speed) {
  const double diagonal = picker_.box().diagonal();
  metresPerSecond_ = std::clamp(speed, 1e-6 * diagonal, 10 * diagonal);
}

std::optional<double> CameraRig::metresAboveGround() const {
  const auto ground = heights_.at(camera_.xy);
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
       .metresPerPixel = 2 * orbit_.orbit().radius * slope / camera_.heightPixels,
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
    } else if (floorMetres_ > 0) {
      there = ground_->aboveFloor(there);
    }
    free_.place(shown(there));
  } else {
    if (motion.isNone()) {
      lastSpeed_ = 0;
      return false;
    }
    orbit_.turn(motion.turnRight, motion.turnUp);
    orbit_.slide(motion.slideRight, motion.slideAhead);
    if (motion.zoom != 1) {
      const auto under = input.wheel != 0 ? picker_.at(camera_, input.mouse, stretch_) : std::nullopt;
      if (under)
        orbit_.zoomAbout({under->metric.x, under->metric.y, under->metric.z * stretch_}, motion.zoom);
      else
        orbit_.zoom(motion.zoom);
    }
    there = asIs(orbit_.camera());
    // The orbit goes on where it would be; only what is seen stays above the floor.
    if (floorMetres_ > 0) there = ground_->aboveFloor(there);
  }
  there.widthPixels = camera_.widthPixels;
  there.heightPixels = camera_.heightPixels;
  camera_ = there;
  lastSpeed_ = input.seconds > 0 ? distance(before, space_.position(camera_)) / input.seconds : 0;
  return !motion.isNone();
}

}  // namespace arete
