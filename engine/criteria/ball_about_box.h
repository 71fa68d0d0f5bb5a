// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "engine/base/box3.h"
#include "engine/base/vec.h"
#include "engine/mt/multitriangulation.h"

namespace arete {

/// The ball about a finite box of a model's coordinates, in metric space, for
/// BoundedCriterion::allowedError(). Floats hold the numbers of a ball to a part in 2^24, so it is larger by
/// some parts in a million. O(1).
inline Sphere ballAboutBox(const Box3& box, const MetricFrame& metric) {
  const Vec3 low = metric.toMetric(box.low), high = metric.toMetric(box.high);
  const Vec3 middle = (low + high) / 2.0;
  const double radius = norm(high - low) / 2;
  const double rounded = 1e-6 * (norm(middle) + radius);
  return {static_cast<float>(middle.x), static_cast<float>(middle.y), static_cast<float>(middle.z),
          static_cast<float>(radius + rounded)};
}

}  // namespace arete
