// SPDX-License-Identifier: GPL-3.0-or-later
//
// The height that is aimed at is the kept one above the highest ground between here and where the camera will
// be soon. Towards it the height moves like a critically damped spring: with d the distance from the aim and
// v the speed, after a time t they are (d + (v + w d) t) exp(-w t) and (v - w (v + w d) t) exp(-w t), in
// closed form, so no length of a frame makes it swing. What then lies below the floor is put on it: a cliff
// that comes up sooner than the spring can lift the camera costs smoothness, never the floor.
#include "viewer/camera/ground_following.h"

#include <algorithm>
#include <cmath>

namespace arete {
namespace {

constexpr int kLooks = 8;

}  // namespace

GroundFollowing::GroundFollowing(const GroundHeights& heights, const CameraSpace& space,
                                 const Options& options)
    : heights_(heights), space_(space), options_(options) {}

std::optional<double> GroundFollowing::groundMetres(Vec2 xy) const {
  const auto ground = heights_.at(xy, options_.maxError);
  if (!ground) return std::nullopt;
  return space_.position(xy, ground->height + ground->below).z;
}

Camera GroundFollowing::aboveFloor(Camera camera) {
  if (const auto ground = groundMetres(camera.xy)) lastGround_ = ground;
  if (!lastGround_) return camera;
  const Vec3 here = space_.position(camera);
  const double floor = *lastGround_ + options_.floorMetres;
  if (here.z < floor) camera.height = space_.height({here.x, here.y, floor});
  return camera;
}

void GroundFollowing::begin(const Camera& camera) {
  const Camera raised = aboveFloor(camera);
  place_ = space_.position(raised);
  climbSpeed_ = 0;
  keep(lastGround_ ? place_.z - *lastGround_ : 0);
}

void GroundFollowing::keep(double metres) {
  kept_ = std::max(metres, options_.floorMetres);
}

Camera GroundFollowing::follow(Camera camera, double seconds) {
  Vec3 here = space_.position(camera);
  here.z = place_.z;
  if (const auto ground = groundMetres(camera.xy)) lastGround_ = ground;
  if (seconds > 0 && lastGround_) {
    double highest = *lastGround_;
    const double ahead = options_.lookAheadSeconds / seconds;
    for (int i = 1; i <= kLooks; ++i) {
      const double part = ahead * i / kLooks;
      const Vec3 soon{here.x + part * (here.x - place_.x), here.y + part * (here.y - place_.y), 0};
      if (const auto ground = groundMetres(space_.xy(soon))) highest = std::max(highest, *ground);
    }
    const double stiffness = 1 / options_.settleSeconds, left = std::exp(-stiffness * seconds);
    const double aim = highest + kept_, off = here.z - aim, push = climbSpeed_ + stiffness * off;
    here.z = aim + (off + push * seconds) * left;
    climbSpeed_ = (climbSpeed_ - stiffness * push * seconds) * left;
  }
  place_ = here;
  const Camera smooth = space_.at(camera, here);
  Camera raised = aboveFloor(smooth);
  if (raised.height > smooth.height) {
    place_.z = space_.position(raised).z;
    climbSpeed_ = std::max(climbSpeed_, 0.0);
  }
  raised.xy = camera.xy;
  return raised;
}

}  // namespace arete
