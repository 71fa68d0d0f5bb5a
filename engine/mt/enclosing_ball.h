// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>

#include "engine/base/vec.h"
#include "engine/mt/multitriangulation.h"

namespace arete {

/// A ball that grows to enclose a node's star and the spheres of its children (law 6), as a saturated
/// bounding sphere [LindstromPascucci2002]. Not the smallest one: it is built in one pass. The same points
/// and children in the same order result in the same bits.
struct EnclosingBall {
  double x, y, z, radius;

  /// Around points: from the centre of their box to the farthest. Precondition: at least one point.
  static EnclosingBall around(std::span<const Vec3> points) {
    Vec3 low = points[0], high = low;
    for (const Vec3& p : points) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    EnclosingBall ball{(low.x + high.x) / 2, (low.y + high.y) / 2, (low.z + high.z) / 2, 0};
    double squared = 0;
    for (const Vec3& p : points)
      squared = std::max(squared, (p.x - ball.x) * (p.x - ball.x) + (p.y - ball.y) * (p.y - ball.y) +
                                      (p.z - ball.z) * (p.z - ball.z));
    ball.radius = std::sqrt(squared);
    return ball;
  }

  static EnclosingBall of(const Sphere& s) { return {s.x, s.y, s.z, s.radius}; }

  void encloseChild(const Sphere& child) {
    const double px = child.x, py = child.y, pz = child.z, pRadius = child.radius * kWiden;
    const double dx = px - x, dy = py - y, dz = pz - z;
    const double distance = std::sqrt(dx * dx + dy * dy + dz * dz);
    if (distance + pRadius <= radius) return;
    if (distance + radius <= pRadius) {
      *this = {px, py, pz, pRadius};
      return;
    }
    const double grown = (distance + radius + pRadius) / 2, shift = (grown - radius) / distance;
    x += dx * shift;
    y += dy * shift;
    z += dz * shift;
    radius = grown;
  }

  /// As it is stored, rounded outwards.
  Sphere rounded() const {
    Sphere s{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), 0};
    const double moved = std::sqrt((s.x - x) * (s.x - x) + (s.y - y) * (s.y - y) + (s.z - z) * (s.z - z));
    // For floats that are not negative, the next float has the next bit pattern.
    s.radius =
        std::bit_cast<float>(std::bit_cast<std::uint32_t>(static_cast<float>((radius + moved) * kWiden)) + 1);
    return s;
  }

 private:
  // A parent's radius is widened a little beyond what rounding needs, so that "child touches => parent
  // touches" survives the arithmetic of any later distance test.
  static constexpr double kWiden = 1 + 1e-6;
};

}  // namespace arete
