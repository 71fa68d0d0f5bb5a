// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>

#include "engine/criteria/criterion.h"
#include "engine/criteria/frustum_filter.h"
#include "engine/criteria/view.h"

namespace arete {

/// At most a number of pixels of error on the screen of a view: a displacement by a triangle's vertical
/// error, anywhere in the frustum, stays within the tolerance on the screen, as the view-dependent criteria
/// of [Hoppe1998] and [LindstromPascucci2002]. A triangle is out of sight if neither it nor the terrain that
/// it represents (its signed bound) meets the frustum.
///
/// The bound holds for the error in any direction, so it is conservative when seen from above. On a surface a
/// triangle is out of sight if the ball around it, widened by its error, is. Precondition:
/// the view is valid.
class ViewError final : public KineticCriterion {
 public:
  struct Options {
    View view;
    double pixels = 1;  ///< > 0
    /// Error allowed out of sight, in the unit of heights.
    double outsideError = std::numeric_limits<double>::infinity();
  };
  /// @param metric The frame of the MT.
  ViewError(const Options& options, const MetricFrame& metric);

  bool isFineEnough(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const override;
  /// The projected error in pixels; out of sight, pixels * error / allowed error.
  double severity(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const override;
  std::optional<double> severityLimit() const override { return o_.pixels; }
  std::unique_ptr<const BoundedCriterion> withSeverityLimit(double pixels) const override;
  double allowedError(const Sphere& s) const override;
  std::uint64_t exceeding(std::span<const Sphere> balls, std::span<const float> errors) const override;
  std::unique_ptr<const KineticCriterion> clone() const override {
    return std::make_unique<ViewError>(*this);
  }
  /// Known between any two views of one kind of projection, whatever their fields of view, picture sizes and
  /// tolerances, unless the near distance, the far distance or the error allowed out of sight differ.
  std::optional<Motion> motionSince(const KineticCriterion& before) const override;
  std::uint64_t exceedingFor(std::span<const Sphere> balls, std::span<const float> errors, const Motion& rate,
                             std::span<float> units) const override;

  const Frustum& frustum() const { return frustum_; }

 private:
  std::uint64_t decide(const FrustumFilter::Verdicts& filtered, std::span<const Sphere> balls,
                       std::span<const float> errors) const;
  double allowedFor(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const;
  double allowedOnSurface(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const;

  Options o_;
  MetricFrame metric_;
  Frustum frustum_;
  double errorPerReach_;  // unit of heights per metric unit of reach
  FrustumFilter filter_;
};

/// The corners of a triangle, moved down and up by its signed bound, in metric space. Their convex hull
/// contains the triangle and the terrain that it represents.
std::array<Vec3, 6> prismOf(const MultiTriangulation& mt, TriangleId t, const Criterion::Corners& corners);

}  // namespace arete
