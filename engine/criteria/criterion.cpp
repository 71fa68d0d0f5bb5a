// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/criteria/criterion.h"

#include <algorithm>
#include <cmath>

#include "engine/base/nearest_on_triangle.h"

namespace arete {

std::uint64_t Criterion::exceeding(std::span<const Sphere> balls, std::span<const float> errors) const {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < balls.size(); ++i)
    bits |= std::uint64_t(errors[i] > allowedError(balls[i]) ? 1 : 0) << i;
  return bits;
}

std::uint64_t RegionError::exceeding(std::span<const Sphere> balls, std::span<const float> errors) const {
  // Most places need no look at the region.
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

double DistanceError::allowedFor(const MultiTriangulation& mt, const Corners& corners) const {
  std::array<Vec3, 3> p;
  for (int i = 0; i < 3; ++i) {
    p[i] = mt.arrays().metric.toMetric(mt.position(VertexId(corners[i])));
    if (o_.inPlan) p[i].z = o_.place.z;
  }
  return allowedAt(distanceToTriangle(o_.place, {p[0], p[1], p[2]}));
}

double DistanceError::severity(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const {
  const double allowed = allowedFor(mt, corners);
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

bool AllOf::isFineEnough(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const {
  return std::ranges::all_of(parts_, [&](const auto& part) { return part->isFineEnough(mt, t, corners); });
}

double AllOf::severity(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const {
  double worst = 0;
  for (const auto& part : parts_)
    if (!part->isFineEnough(mt, t, corners)) worst = std::max(worst, part->severity(mt, t, corners));
  return worst;
}

bool AllOf::isMonotone() const {
  return std::ranges::all_of(parts_, [](const auto& part) { return part->isMonotone(); });
}

double AllOf::allowedError(const Sphere& s) const {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& part : parts_) least = std::min(least, part->allowedError(s));
  return least;
}

double AllOf::mostAllowed(const Sphere& s) const {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& part : parts_) least = std::min(least, part->mostAllowed(s));
  return least;
}

std::uint64_t AllOf::exceeding(std::span<const Sphere> balls, std::span<const float> errors) const {
  std::uint64_t bits = 0;
  for (const auto& part : parts_) bits |= part->exceeding(balls, errors);
  return bits;
}

bool AnyOf::isFineEnough(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const {
  return std::ranges::any_of(parts_, [&](const auto& part) { return part->isFineEnough(mt, t, corners); });
}

double AnyOf::severity(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& part : parts_) least = std::min(least, part->severity(mt, t, corners));
  return least;
}

bool AnyOf::isMonotone() const {
  return std::ranges::all_of(parts_, [](const auto& part) { return part->isMonotone(); });
}

double AnyOf::allowedError(const Sphere& s) const {
  double largest = 0;
  for (const auto& part : parts_) largest = std::max(largest, part->allowedError(s));
  return largest;
}

double AnyOf::mostAllowed(const Sphere& s) const {
  double largest = 0;
  for (const auto& part : parts_) largest = std::max(largest, part->mostAllowed(s));
  return largest;
}

std::uint64_t AnyOf::exceeding(std::span<const Sphere> balls, std::span<const float> errors) const {
  std::uint64_t bits = ~std::uint64_t(0);
  for (const auto& part : parts_) bits &= part->exceeding(balls, errors);
  return bits;
}

}  // namespace arete
