// SPDX-License-Identifier: GPL-3.0-or-later
//
// The allowed error is the tolerance in pixels times the reach (view.cpp) of the ball around the triangle's
// prism, or of the node's sphere. Many spheres at once are first filtered in single precision
// (frustum_filter.h); those too close to call are decided here in double, so the result is that of double
// precision throughout.
#include "engine/criteria/view_error.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "engine/mt/enclosing_ball.h"

namespace arete {

std::array<Vec3, 6> prismOf(const MultiTriangulation& mt, TriangleId t, const Criterion::Corners& corners) {
  const double above = mt.decoded(kAbove, t), below = mt.decoded(kBelow, t);
  std::array<Vec3, 6> prism;
  for (int i = 0; i < 3; ++i) {
    const Vec3 p = mt.position(VertexId(corners[i]));
    // z_TIN - z_reference lies in [-below, above].
    prism[i] = mt.metric().toMetric({p.x, p.y, p.z - above});
    prism[i + 3] = mt.metric().toMetric({p.x, p.y, p.z + below});
  }
  return prism;
}

ViewError::ViewError(const Options& options, const MetricFrame& metric)
    : o_(options),
      metric_(metric),
      frustum_(options.view),
      errorPerReach_(options.pixels / frustum_.pixelsPerUnit() / std::abs(metric.scale.z)),
      filter_(options.view, errorPerReach_, options.outsideError) {}

double ViewError::allowedOnSurface(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const {
  const auto at = [&](std::size_t i) { return metric_.toMetric(mt.position(VertexId(corners[i]))); };
  const std::array<Vec3, 3> places{at(0), at(1), at(2)};
  // On a surface an error has no direction, so the ball around the triangle grows by it on all sides.
  const EnclosingBall ball = EnclosingBall::around(places);
  const double radius = (ball.radius + mt.error(t)) * (1 + 1e-9);
  const Vec3 centre = frustum_.toView({ball.x, ball.y, ball.z});
  if (!frustum_.mayMeet(centre, radius)) return o_.outsideError;
  return std::min(errorPerReach_ * frustum_.reach(centre, radius, centre.z - radius), o_.outsideError);
}

double ViewError::allowedFor(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const {
  if (!mt.vertices().hasPlan()) return allowedOnSurface(mt, t, corners);
  std::array<Vec3, 6> prism = prismOf(mt, t, corners);
  for (Vec3& p : prism) p = frustum_.toView(p);
  if (!frustum_.mayMeet(prism)) return o_.outsideError;
  Vec3 low = prism[0], high = prism[0];
  for (const Vec3& p : prism) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  // A ball around the middle of the prism's box holds all corners of the prism.
  const Vec3 centre{(low.x + high.x) / 2, (low.y + high.y) / 2, (low.z + high.z) / 2};
  double squared = 0;
  for (const Vec3& p : prism)
    squared = std::max(squared, (p.x - centre.x) * (p.x - centre.x) + (p.y - centre.y) * (p.y - centre.y) +
                                    (p.z - centre.z) * (p.z - centre.z));
  return std::min(errorPerReach_ * frustum_.reach(centre, std::sqrt(squared), low.z), o_.outsideError);
}

bool ViewError::isFineEnough(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const {
  // An exact triangle is fine enough from everywhere, which spares its prism.
  const double error = mt.error(t);
  return error == 0 || error <= allowedFor(mt, t, corners);
}

double ViewError::severity(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const {
  const double error = mt.error(t);
  return error == 0 ? 0 : o_.pixels * error / allowedFor(mt, t, corners);
}

std::unique_ptr<const BoundedCriterion> ViewError::withSeverityLimit(double pixels) const {
  Options options = o_;
  options.pixels = pixels;
  // The error outside of the view grows with the tolerance, so that the two keep their ratio.
  options.outsideError *= pixels / o_.pixels;
  return std::make_unique<ViewError>(options, metric_);
}

std::uint64_t ViewError::decide(const FrustumFilter::Verdicts& filtered, std::span<const Sphere> balls,
                                std::span<const float> errors) const {
  std::uint64_t exceeds = filtered.exceeds;
  for (std::uint64_t unsure = filtered.unsure; unsure != 0; unsure &= unsure - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(unsure));
    if (errors[i] > allowedError(balls[i])) exceeds |= std::uint64_t(1) << i;
  }
  return exceeds;
}

std::uint64_t ViewError::exceeding(std::span<const Sphere> balls, std::span<const float> errors) const {
  return decide(filter_.test(balls, errors), balls, errors);
}

std::uint64_t ViewError::exceedingFor(std::span<const Sphere> balls, std::span<const float> errors,
                                      const Motion& rate, std::span<float> units) const {
  return decide(filter_.testFor(balls, errors, rate, units), balls, errors);
}

std::optional<Motion> ViewError::motionSince(const KineticCriterion& before) const {
  const auto* old = dynamic_cast<const ViewError*>(&before);
  if (old == nullptr || old->frustum_.isParallel() != frustum_.isParallel() ||
      old->o_.view.nearDistance != o_.view.nearDistance || old->o_.view.farDistance != o_.view.farDistance ||
      old->o_.outsideError != o_.outsideError)
    return {};
  const Frustum::Planes a = old->frustum_.planes(), b = frustum_.planes();
  const auto squared = [](const Vec3& p, const Vec3& q) {
    return (p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y) + (p.z - q.z) * (p.z - q.z);
  };
  // A rotation by an angle moves the three axes by 2 sqrt(2) sin(angle / 2), as one vector of nine
  // components.
  const double axes =
      std::sqrt(squared(a.right, b.right) + squared(a.up, b.up) + squared(a.forward, b.forward));
  const double planes = std::max(std::abs(std::atan(a.slopeX) - std::atan(b.slopeX)),
                                 std::abs(std::atan(a.slopeY) - std::atan(b.slopeY)));
  constexpr double kWiden = 1 + 1e-9;
  const double halves = std::max(std::abs(a.halfX - b.halfX), std::abs(a.halfY - b.halfY));
  return Motion{.travel = kWiden * (std::sqrt(squared(old->o_.view.eye, o_.view.eye)) + halves),
                .turn = kWiden * (2 * std::asin(std::min(1.0, axes / (2 * std::numbers::sqrt2))) + planes),
                // The allowed error grows at most with the square of the cosine at the corner.
                .scale = kWiden * (std::abs(std::log(errorPerReach_ / old->errorPerReach_)) +
                                   2 * std::abs(std::log(b.leastCosine / a.leastCosine)))};
}

double ViewError::allowedError(const Sphere& s) const {
  if (!frustum_.mayMeet(s)) return o_.outsideError;
  const Vec3 centre = frustum_.toView({s.x, s.y, s.z});
  const double reach = frustum_.reach(centre, s.radius, centre.z - s.radius);
  return std::min(errorPerReach_ * reach, o_.outsideError);
}

}  // namespace arete
