// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <utility>

#include "engine/base/nearest_on_triangle.h"
#include "engine/base/vec.h"
#include "engine/criteria/criterion.h"
#include "engine/mt/multitriangulation.h"

namespace arete {

/// A closed region of space. Thread-safe.
class SpaceRegion {
 public:
  virtual ~SpaceRegion() = default;

  /// Whether it is within a distance of a triangle: whether it meets the triangle, widened by that.
  /// Conservative for a triangle that only touches.
  /// @param widening >= 0
  virtual bool meetsTriangle(const SpaceTriangle& triangle, double widening) const = 0;
  /// Whether a ball meets it, and whether it holds the ball. Conservative: the ball is widened by one part in
  /// 1e9 for the first, and for the second too.
  virtual bool meetsBall(const Vec3& c, double r) const = 0;
  virtual bool holdsBall(const Vec3& c, double r) const = 0;
};

/// Precondition: low <= high in every coordinate.
class BoxRegion final : public SpaceRegion {
 public:
  BoxRegion(const Vec3& low, const Vec3& high) : low_(low), high_(high) {}
  bool meetsTriangle(const SpaceTriangle& triangle, double widening) const override;
  bool meetsBall(const Vec3& c, double r) const override;
  bool holdsBall(const Vec3& c, double r) const override;

 private:
  Vec3 low_, high_;
};

/// Precondition: radius >= 0.
class BallRegion final : public SpaceRegion {
 public:
  BallRegion(const Vec3& centre, double radius) : centre_(centre), radius_(radius) {}
  bool meetsTriangle(const SpaceTriangle& triangle, double widening) const override;
  bool meetsBall(const Vec3& c, double r) const override;
  bool holdsBall(const Vec3& c, double r) const override;

 private:
  Vec3 centre_;
  double radius_;
};

/// Of a surface: one error for the points of the source that are in a region of space, another for the rest.
/// What of the source a coarse triangle stands for lies beside the triangle, within its stored error: the
/// triangle, widened by that, is held against the region. The ball of a node contains what of the source its
/// triangles stand for.
class SpaceRegionError final : public BoundedCriterion {
 public:
  /// @param region In the coordinates of the MT's vertices.
  /// @param metric The frame of the MT; its scale is 1, as of every surface.
  /// Precondition: insideError <= outsideError.
  SpaceRegionError(std::shared_ptr<const SpaceRegion> region, const MetricFrame& metric, double insideError,
                   double outsideError)
      : region_(std::move(region)),
        origin_(metric.origin),
        insideError_(insideError),
        outsideError_(outsideError) {}

  bool isFineEnough(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const override;
  double allowedError(const Sphere& s) const override {
    return region_->meetsBall(placeOf(s), s.radius) ? insideError_ : outsideError_;
  }
  double mostAllowed(const Sphere& s) const override {
    return region_->holdsBall(placeOf(s), s.radius) ? insideError_ : outsideError_;
  }

 private:
  Vec3 placeOf(const Sphere& s) const { return Vec3{s.x, s.y, s.z} + origin_; }

  std::shared_ptr<const SpaceRegion> region_;
  Vec3 origin_;
  double insideError_, outsideError_;
};

}  // namespace arete
