// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "engine/base/vec.h"
#include "engine/criteria/criterion.h"
#include "engine/mt/multitriangulation.h"

namespace arete {

/// A closed region of space: an axis-aligned box, or a ball.
struct SpaceRegion {
  enum class Shape { box, ball };
  Shape shape = Shape::box;
  Vec3 low, high;     ///< of the box
  Vec3 centre;        ///< of the ball
  double radius = 0;  ///< of the ball, >= 0

  /// Whether a triangle meets it. Conservative for a triangle that only touches a box.
  bool meetsTriangle(const Vec3& a, const Vec3& b, const Vec3& c) const;
  /// Whether a ball meets it, and whether it holds the ball. Conservative: the ball is widened by one part in
  /// 1e9 for the first, and for the second too.
  bool meetsBall(const Vec3& c, double r) const;
  bool holdsBall(const Vec3& c, double r) const;
};

/// Of a surface: one error for the triangles that meet a region of space, another for the rest.
class SpaceRegionError final : public BoundedCriterion {
 public:
  /// @param region In the coordinates of the MT's vertices.
  /// @param metric The frame of the MT; its scale is 1, as of every surface.
  /// Precondition: insideError <= outsideError.
  SpaceRegionError(const SpaceRegion& region, const MetricFrame& metric, double insideError,
                   double outsideError)
      : region_(region), origin_(metric.origin), insideError_(insideError), outsideError_(outsideError) {}

  bool isFineEnough(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const override;
  double allowedError(const Sphere& s) const override {
    return region_.meetsBall(placeOf(s), s.radius) ? insideError_ : outsideError_;
  }
  double mostAllowed(const Sphere& s) const override {
    return region_.holdsBall(placeOf(s), s.radius) ? insideError_ : outsideError_;
  }

 private:
  Vec3 placeOf(const Sphere& s) const { return Vec3{s.x, s.y, s.z} + origin_; }

  SpaceRegion region_;
  Vec3 origin_;
  double insideError_, outsideError_;
};

}  // namespace arete
