// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "engine/base/vec.h"

namespace arete::measuring {

/// A full turn and half a turn, in the additive pseudo-angle that detects triangles overlapping around a
/// sample.
inline constexpr float kFullTurn = 4, kHalfTurn = 2;

/// The counter-clockwise turn around a point from one position to another, as a pseudo-angle in [0, 4]:
/// additive, opposite directions exactly half a turn apart. Precondition: neither position is the point.
float turnBetween(Vec2 around, Vec2 from, Vec2 to);

/// How a triangle meets a point of the plan.
struct Contact {
  bool covers = false;  ///< within the plan tolerance of the triangle
  bool strict = false;  ///< inside by more than the plan tolerance
  double z = 0;         ///< of the triangle's plane there; outside, at the nearest point of the triangle
  float turn = 0;       ///< the part of a full turn that the triangle fills around the point
};

/// A triangle of the plan prepared for many point queries. The unit of length is the pixel.
///
/// Corners are counter-clockwise. Side i is opposite corner i and runs from corner i+1 to corner i+2;
/// its side function w_i(p) = cross(side_i, p - corner_{i+1}) is twice the area of (side i, p), so that w_i
/// over area2 is the barycentric weight of corner i and w_i over length_i the signed distance of p from the
/// side, positive inside.
struct PlanTriangle {
  std::array<Vec2, 3> corner;
  std::array<double, 3> z;
  std::array<Vec2, 3> side;
  std::array<double, 3> length;
  double area2 = 0;  ///< twice the plan area, > 0

  /// Sets the triangle; clockwise corners are reversed.
  /// @return false where it is degenerate: nowhere thicker than `tolerance`
  bool set(const std::array<Vec2, 3>& corners, const std::array<double, 3>& heights, double tolerance);

  double sideFunction(int i, double x, double y) const {
    const Vec2& from = corner[(i + 1) % 3];
    return side[i].x * (y - from.y) - side[i].y * (x - from.x);
  }

  /// Height of the plane at the point with the side functions w1 and w2 of corners 1 and 2.
  double heightFromWeights(double w1, double w2) const;

  /// How the triangle meets the point (x, y). Exact where the corners are integers; otherwise within a few
  /// ulp of the coordinates' magnitude. O(1).
  Contact contact(double x, double y, double tolerance) const;

 private:
  float cornerTurn(int i) const;
};

}  // namespace arete::measuring
