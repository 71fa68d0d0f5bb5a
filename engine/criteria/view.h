// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "engine/mt/multitriangulation.h"

namespace arete {

/// A view in perspective or in parallel projection as plain numbers, in the metric space of an MT
/// (MetricFrame::toMetric). That space may be mirrored relative to the map. A view need not be mirrored: it
/// is symmetric from left to right.
struct View {
  Vec3 eye;
  Vec3 forward = {0, 1, 0};                         ///< of any length but 0
  Vec3 up = {0, 0, 1};                              ///< not along forward
  double verticalFieldOfView = 1.0471975511965976;  ///< radians, below pi
  double widthPixels = 1920, heightPixels = 1080;
  double nearDistance = 0;  ///< depths along forward, in metric units; in parallel projection below 0 too
  double farDistance = std::numeric_limits<double>::infinity();
  /// Above 0: a parallel projection along forward, whose picture has this height in metric units; pixels are
  /// square, and the field of view is not used. The eye is in the middle of the picture. What lies behind it
  /// is seen if nearDistance is below 0, from minus infinity on all of it. 0: perspective.
  double parallelHeight = 0;

  bool isParallel() const { return parallelHeight > 0; }

  /// Errors: usage: a number is invalid; the message names it.
  Status validate() const;
};

/// The visible part of space: the points (x, y, z) in the eye's axes, z forward, with near <= z <= far and
/// |x| and |y| at most a fixed multiple of z in perspective, at most a fixed number in parallel projection.
class Frustum {
 public:
  /// Precondition: the view validates.
  explicit Frustum(const View& view);

  /// Coordinates along the eye's axes: right, up, forward.
  Vec3 toView(const Vec3& p) const {
    const Vec3 d{p.x - eye_.x, p.y - eye_.y, p.z - eye_.z};
    return {d.x * right_.x + d.y * right_.y + d.z * right_.z, d.x * up_.x + d.y * up_.y + d.z * up_.z,
            d.x * forward_.x + d.y * forward_.y + d.z * forward_.z};
  }
  /// False if all of the points lie beyond one of the planes; then so does their convex hull.
  /// @param inView Points in the eye's axes, as of toView().
  bool mayMeet(std::span<const Vec3> inView) const;
  /// False if the ball lies beyond one of the planes.
  bool mayMeet(const Sphere& ball) const { return mayMeet(toView({ball.x, ball.y, ball.z}), ball.radius); }
  /// The same for a centre in the eye's axes.
  bool mayMeet(const Vec3& centre, double radius) const {
    return std::abs(centre.x) - slopeX_ * centre.z - halfX_ <= radius * lengthX_ &&
           std::abs(centre.y) - slopeY_ * centre.z - halfY_ <= radius * lengthY_ &&
           centre.z + radius >= near_ && centre.z - radius <= far_;
  }

  /// A lower bound of depth^2 / distance over the points that are in both the ball and the frustum: a
  /// displacement of length e there moves nothing by more than e * pixelsPerUnit() / reach() on the screen.
  /// 0 if the ball contains the eye. 1 in parallel projection, where nothing is larger for being near.
  /// @param centre In the eye's axes.
  /// @param leastDepth A lower bound of the depths in the ball.
  double reach(const Vec3& centre, double radius, double leastDepth) const;
  /// A lower bound of reach() by the least depth alone.
  double reachByDepth(double leastDepth) const {
    return isParallel_ ? 1 : std::max(leastDepth, near_) * leastCosine_;
  }
  bool isParallel() const { return isParallel_; }
  double pixelsPerUnit() const { return pixelsPerUnit_; }
  double nearDistance() const { return near_; }
  double farDistance() const { return far_; }
  const Vec3& eye() const { return eye_; }

  /// The eye's axes; the side planes |x| = slopeX z + halfX and |y| = slopeY z + halfY and the lengths of
  /// their normals; the cosine of the angle between the axis and the corners of the picture. The halves are 0
  /// in perspective, the slopes in parallel projection.
  struct Planes {
    Vec3 right, up, forward;
    double slopeX, slopeY, lengthX, lengthY, leastCosine;
    double halfX = 0, halfY = 0;

    /// Half the width and half the height of the picture at a depth.
    double halfWidth(double depth) const { return slopeX * depth + halfX; }
    double halfHeight(double depth) const { return slopeY * depth + halfY; }
  };
  Planes planes() const {
    return {right_, up_, forward_, slopeX_, slopeY_, lengthX_, lengthY_, leastCosine_, halfX_, halfY_};
  }

 private:
  Vec3 eye_, right_, up_, forward_;
  double slopeX_, slopeY_;  // of the side planes
  double halfX_ = 0, halfY_ = 0;
  double lengthX_, lengthY_;  // of their normals
  double near_, far_;
  double leastCosine_;  // of the angle between forward and a direction in the frustum
  double pixelsPerUnit_;
  bool isParallel_;
};

}  // namespace arete
