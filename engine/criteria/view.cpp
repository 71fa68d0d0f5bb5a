// SPDX-License-Identifier: GPL-3.0-or-later
//
// On a screen of focal length f pixels the point (x, y, z) appears at f (x, y) / z. A displacement of length
// e moves it by at most e f d / z^2, d its distance and z its depth: the largest singular value of that map's
// derivative, reached by a displacement across the sight line and away from the axis. So a bound of z^2 / d
// from below bounds the displacement on the screen. Over a ball there are two, and the larger is used: z >=
// the ball's least depth and z / d = cos(angle) >= the cosine at the frustum's corner; d >= the ball's least
// distance and the cosine at the largest angle that the ball reaches.
//
// In parallel projection (x, y, z) appears at f (x, y), f pixels per metric unit, so e moves it by at most f
// e wherever it is: a reach of 1 has the same bound.
#include "engine/criteria/view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/caught_failure.h"

namespace arete {
Status View::validate() const try {
  const auto refuse = [](const char* message) { return failure(ErrorCode::usage, message, "view"); };
  if (!isFinite(eye) || !isFinite(forward) || !isFinite(up))
    return refuse("the eye and its directions must be finite");
  const Vec3 side = cross(forward, up);
  if (!(dot(side, side) > 1e-18 * dot(forward, forward) * dot(up, up)))
    return refuse("forward and up must be two different directions");
  if (!(parallelHeight >= 0 && std::isfinite(parallelHeight)))
    return refuse("the height of a parallel picture must be above 0 and finite");
  if (!(verticalFieldOfView > 0 && verticalFieldOfView < std::numbers::pi))
    return refuse("the field of view must be above 0 and below 180 degrees");
  if (!(widthPixels >= 1 && heightPixels >= 1 && std::isfinite(widthPixels) && std::isfinite(heightPixels)))
    return refuse("the picture must have a pixel at least");
  if (isParallel() && !(nearDistance < farDistance))
    return refuse("the near distance must be below the far distance");
  if (!isParallel() && !(nearDistance >= 0 && nearDistance < farDistance))
    return refuse("the near distance must be at least 0 and below the far distance");
  return {};
} catch (...) {
  return caughtFailure();
}

Frustum::Frustum(const View& view)
    : eye_(view.eye),
      forward_(unit(view.forward)),
      slopeY_(view.isParallel() ? 0 : std::tan(view.verticalFieldOfView / 2)),
      near_(view.nearDistance),
      far_(view.farDistance),
      isParallel_(view.isParallel()) {
  right_ = unit(cross(forward_, view.up));
  up_ = cross(right_, forward_);
  slopeX_ = slopeY_ * view.widthPixels / view.heightPixels;
  lengthX_ = std::sqrt(1 + slopeX_ * slopeX_);
  lengthY_ = std::sqrt(1 + slopeY_ * slopeY_);
  leastCosine_ = 1 / std::sqrt(1 + slopeX_ * slopeX_ + slopeY_ * slopeY_);
  pixelsPerUnit_ = view.heightPixels / (2 * slopeY_);
  if (!isParallel_) return;
  halfY_ = view.parallelHeight / 2;
  halfX_ = halfY_ * view.widthPixels / view.heightPixels;
  pixelsPerUnit_ = view.heightPixels / view.parallelHeight;
}

bool Frustum::mayMeet(std::span<const Vec3> inView) const {
  unsigned beyondAll = 0x3F;
  for (const Vec3& p : inView) {
    unsigned beyond = 0;
    beyond |= p.x > slopeX_ * p.z + halfX_ ? 1u : 0u;
    beyond |= -p.x > slopeX_ * p.z + halfX_ ? 2u : 0u;
    beyond |= p.y > slopeY_ * p.z + halfY_ ? 4u : 0u;
    beyond |= -p.y > slopeY_ * p.z + halfY_ ? 8u : 0u;
    beyond |= p.z < near_ ? 16u : 0u;
    beyond |= p.z > far_ ? 32u : 0u;
    beyondAll &= beyond;
  }
  return beyondAll == 0;
}

double Frustum::reach(const Vec3& p, double radius, double leastDepth) const {
  if (isParallel_) return 1;
  const double distance = std::sqrt(dot(p, p)), nearest = distance - radius;
  const double byDepth = reachByDepth(leastDepth);
  if (nearest <= 0) return byDepth;
  const double cosine = p.z / distance, sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  const double ballSine = radius / distance, ballCosine = std::sqrt(std::max(0.0, 1 - ballSine * ballSine));
  const double reached = std::max(leastCosine_, cosine * ballCosine - sine * ballSine);
  return std::max(byDepth, nearest * reached * reached);
}

}  // namespace arete
