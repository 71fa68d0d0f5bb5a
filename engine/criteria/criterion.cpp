// SPDX-License-Identifier: GPL-3.0-or-later
//
// A criterion by location decides about a triangle from its corners, and about a ball from the distances of
// its nearest and farthest points. Where both errors of a region agree on a verdict the region is not
// queried.
#include "engine/criteria/criterion.h"

#include <algorithm>
#include <cmath>

#include "engine/base/nearest_on_triangle.h"

namespace arete {

std::uint64_t BoundedCriterion::exceeding(std::span<const Sphere> balls,
                                          std::span<const float> errors) const {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < balls.size(); ++i)
    bits |= std::uint64_t(errors[i] > allowedError(balls[i]) ? 1 : 0) << i;
  return bits;
}

std::uint64_t RegionError::exceeding(std::span<const Sphere> balls, std::span<const float> errors) const {
  // Few balls have an error between the two: only these need the region.
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const bool exceeds =
        errors[i] > outsideError_ ||
        (errors[i] > insideError_ && metricRegion_.meetsDisc({balls[i].x, balls[i].y}, balls[i].radius));
    bits |= std::uint64_t(exceeds ? 1 : 0) << i;
  }
  return bits;
}

bool RegionError::isFineEnough(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const {
  const double error = mt.error(t);
  if (error <= insideError_) return true;
  if (error > outsideError_) return false;
  const auto& v = mt.vertices();
  return !region_.meetsTriangle(v.planPosition(VertexId(corners[0])), v.planPosition(VertexId(corners[1])),
                                v.planPosition(VertexId(corners[2])));
}

double DistanceError::allowedAt(double distance) const {
  return std::min(o_.nearError + o_.growth * distance, o_.farError);
}

double DistanceError::allowedFor(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const {
  std::array<Vec3, 3> p;
  for (int i = 0; i < 3; ++i) {
    p[i] = mt.metric().toMetric(mt.position(VertexId(corners[i])));
    if (o_.inPlan) p[i].z = o_.place.z;
  }
  // How far the source that the triangle stands for may be from it.
  const bool isBeside = !mt.vertices().hasPlan();
  const double away = isBeside ? mt.error(t) : o_.inPlan ? 0 : mt.error(t) * std::abs(mt.metric().scale.z);
  return allowedAt(std::max(0.0, distanceToTriangle(o_.place, {p[0], p[1], p[2]}) - away));
}

double DistanceError::severity(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const {
  const double allowed = allowedFor(mt, t, corners);
  return allowed > 0 ? mt.error(t) / allowed : std::numeric_limits<double>::infinity();
}

double DistanceError::distanceToMiddle(const Sphere& s) const {
  const double dx = s.x - o_.place.x, dy = s.y - o_.place.y, dz = o_.inPlan ? 0 : s.z - o_.place.z;
  return std::sqrt(dx * dx + dy * dy + dz * dz);
}

double DistanceError::allowedError(const Sphere& s) const {
  return allowedAt(std::max(0.0, distanceToMiddle(s) - s.radius));
}

double DistanceError::mostAllowed(const Sphere& s) const {
  constexpr double kRounding = 1 + 1e-9;
  return allowedAt((distanceToMiddle(s) + s.radius) * kRounding);
}

}  // namespace arete
