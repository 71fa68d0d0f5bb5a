// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "engine/base/vec.h"
#include "engine/mt/multitriangulation.h"

namespace arete {

/// Where a ray meets a surface.
struct RayHit {
  double along = 0;       ///< in lengths of its direction
  TriangleId triangle{};  ///< of the finest front
};

/// Finds where a ray meets the finest front of a multitriangulation first, on either side of its triangles: a
/// descent through the nodes whose spheres it meets. Edges belong to both of their triangles, with a
/// billionth of their length around them, so that nothing passes between two; a triangle that the ray lies in
/// is met at its neighbours. O(root triangles + nodes along the ray). Thread-safe.
///
/// @param from,direction in metric space (MetricFrame); the direction has any length but 0
std::optional<RayHit> firstHit(const MultiTriangulation& mt, const Vec3& from, const Vec3& direction);

}  // namespace arete
