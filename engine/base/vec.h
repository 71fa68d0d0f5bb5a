// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace arete {

struct Vec2 {
  double x = 0, y = 0;
  constexpr bool operator==(const Vec2&) const = default;
};

struct Vec3 {
  double x = 0, y = 0, z = 0;
  constexpr bool operator==(const Vec3&) const = default;
};

/// An axis-aligned box in the plan, both ends included.
struct Box2 {
  double xMin = 0, yMin = 0, xMax = 0, yMax = 0;
};

}  // namespace arete
