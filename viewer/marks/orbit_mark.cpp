// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/marks/orbit_mark.h"

#include <cmath>
#include <numbers>

namespace arete {
namespace {

constexpr Rgba kOrbitInk = {190, 30, 190, 255};
constexpr int kCorners = 16;
/// Of the orbit's radius: half a side of the square and half the cylinder's height; the cylinder's radius.
constexpr double kReach = 0.07, kThickness = 0.012;

}  // namespace

SpaceVertices orbitMark(const OrbitPlace& orbit) {
  SpaceVertices lines;
  const Vec3& c = orbit.centre;
  const double r = kReach * orbit.radius, thin = kThickness * orbit.radius;
  const Vec3 a{c.x - r, c.y - r, c.z}, b{c.x + r, c.y - r, c.z}, d{c.x + r, c.y + r, c.z},
      e{c.x - r, c.y + r, c.z};
  for (const auto& [from, to] : {std::pair{a, b}, {b, d}, {d, e}, {e, a}, {a, d}, {b, e}})
    lines.addLine(from, to, kOrbitInk);
  const auto rim = [&](int i, double z) {
    const double turn = 2 * std::numbers::pi * i / kCorners;
    return Vec3{c.x + thin * std::cos(turn), c.y + thin * std::sin(turn), z};
  };
  for (int i = 0; i < kCorners; ++i) {
    for (const double z : {c.z - r, c.z + r}) lines.addLine(rim(i, z), rim(i + 1, z), kOrbitInk);
    if (i % 4 == 0) lines.addLine(rim(i, c.z - r), rim(i, c.z + r), kOrbitInk);
  }
  return lines;
}

}  // namespace arete
