// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "engine/multitriangulation.h"
#include "engine/region.h"

namespace arete {

/// c(t): when a triangle is fine enough (Mirza, Skvortsov, Sobolev). Errors are vertical, in the unit of the
/// heights.
///
/// A criterion that allows an error by place says so through allowedError(): then it can steer the saturated
/// cut, whose test per node needs a bound over the node's sphere. Any other criterion (isMonotone() false)
/// steers the minimal cut.
class Criterion {
 public:
  virtual ~Criterion() = default;

  /// Whether the triangle may stay in the front.
  virtual bool isFineEnough(const MultiTriangulation& mt, TriangleId t,
                            const std::array<std::uint32_t, 3>& corners) const = 0;

  /// Whether allowedError() is a bound: for every ball inside another it is at least the other's.
  virtual bool isMonotone() const { return false; }
  /// The least error that the criterion allows to any triangle that meets the ball (metric space).
  virtual double allowedError(const Sphere&) const { return 0; }

  /// The same error allowed everywhere: the front is then found without looking at places. NaN otherwise.
  virtual double uniformError() const { return std::numeric_limits<double>::quiet_NaN(); }
};

/// Error at most E everywhere.
class UniformError final : public Criterion {
 public:
  explicit UniformError(double maxError) : maxError_(maxError) {}
  bool isFineEnough(const MultiTriangulation& mt, TriangleId t,
                    const std::array<std::uint32_t, 3>&) const override {
    return mt.error(t) <= maxError_;
  }
  bool isMonotone() const override { return true; }
  double allowedError(const Sphere&) const override { return maxError_; }
  double uniformError() const override { return maxError_; }

 private:
  double maxError_;
};

/// One error for the triangles that touch a region of the plan, another for the rest.
class RegionError final : public Criterion {
 public:
  /// The region is in plan coordinates of the MT. Precondition: insideError <= outsideError.
  RegionError(Region region, const MetricFrame& metric, double insideError, double outsideError)
      : region_(std::move(region)),
        metricRegion_(region_.scaled(metric)),
        insideError_(insideError),
        outsideError_(outsideError) {}

  bool isFineEnough(const MultiTriangulation& mt, TriangleId t,
                    const std::array<std::uint32_t, 3>& corners) const override {
    const double error = mt.error(t);
    if (error <= insideError_) return true;
    if (error > outsideError_) return false;
    const auto& v = mt.vertices();
    return !region_.meetsTriangle(v.planPosition(VertexId(corners[0])), v.planPosition(VertexId(corners[1])),
                                  v.planPosition(VertexId(corners[2])));
  }
  bool isMonotone() const override { return true; }
  double allowedError(const Sphere& s) const override {
    return metricRegion_.meetsDisc({s.x, s.y}, s.radius) ? insideError_ : outsideError_;
  }
  const Region& region() const { return region_; }

 private:
  Region region_, metricRegion_;
  double insideError_, outsideError_;
};

}  // namespace arete
