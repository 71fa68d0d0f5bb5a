// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "engine/base/vec.h"
#include "viewer/fronts/morphing_front.h"

namespace arete {

/// Triangles as they are drawn.
struct TriangleList {
  std::span<const FrontChanges::Corners> corners;
  std::function<Vec3(std::uint32_t)> place;  ///< of a corner
  bool isFrontAlone = false;                 ///< the ray passes through what is turned away from it
};

/// A triangle of a list that a ray meets.
struct MetTriangle {
  double along = 0;       ///< in lengths of the direction, >= 0
  std::size_t index = 0;  ///< in the list
};

/// The first triangle along a ray, by a look at each: for a click. Edges belong to both of their triangles.
/// O(triangles).
std::optional<MetTriangle> firstMet(const TriangleList& list, const Vec3& from, const Vec3& direction);

}  // namespace arete
