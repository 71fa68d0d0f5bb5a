// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <numbers>

#include "engine/base/vec.h"

namespace arete {

/// Where nothing else is stated, an edge is hard from more than this angle between its faces.
inline constexpr double kCreaseDegrees = 45;

/// Rounded coordinates turn faces by so much: the sides of a prism of eight, 45 degrees apart, are alike all
/// around.
inline constexpr double kCreaseSlackDegrees = 1e-4;

/// Whether the edge between two faces is a crease: their normals, of any length, differ by more than
/// `degrees` (0..180) and the slack. A face without area has no normal and makes no crease. The angle is
/// taken by its tangent: an arc cosine would lose half the digits on nearly flat ground.
inline bool isCrease(const Vec3& m, const Vec3& n, double degrees) {
  const double angle = std::atan2(norm(cross(m, n)), dot(m, n));
  return angle > (degrees + kCreaseSlackDegrees) * std::numbers::pi / 180;
}

}  // namespace arete
