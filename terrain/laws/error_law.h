// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "engine/base/vec.h"
#include "engine/mt/multitriangulation.h"

/// What the checks of law 10 on rasters and on points share. No code of the build is used.
namespace arete::laws {

/// What a multitriangulation says of a triangle.
struct StoredErrors {
  double error;         ///< |z - plane| at the samples covered is at most this
  double below, above;  ///< z_TIN - z_reference lies in [-below, above]

  bool holdBound(double difference, double rounding) const {
    return difference + rounding <= above && rounding - difference <= below;
  }
  bool hold(double difference, double rounding) const {
    return holdBound(difference, rounding) && std::abs(difference) + rounding <= error;
  }
};

inline StoredErrors storedErrors(const MultiTriangulation& mt, std::uint32_t triangle) {
  const TriangleId t(triangle);
  return {mt.error(t), mt.decoded(kBelow, t), mt.decoded(kAbove, t)};
}

/// Whether the errors hold at a sample, by exact arithmetic.
/// @param corner  counter-clockwise in the plan; the triangle covers the sample
bool holdAtSample(const StoredErrors& stored, const std::array<Vec3, 3>& corner, const Vec3& sample);

/// Whether the bounds hold where the triangle's edge a-b crosses the edge p-q of the finest triangulation, by
/// exact arithmetic. Precondition: each edge has its ends strictly on different sides of the other one.
bool holdAtCrossing(const StoredErrors& stored, const Vec3& a, const Vec3& b, const Vec3& p, const Vec3& q);

/// The first failing triangle of law 10 is looked for by these, one triangle at a time.
class ErrorLaw {
 public:
  virtual ~ErrorLaw() = default;
  /// Whether the errors stored with a triangle are at least the true ones. Thread-safe.
  virtual bool holds(std::uint32_t triangle) const = 0;
};

}  // namespace arete::laws
