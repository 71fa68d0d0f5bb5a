// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>

#include "engine/base/vec.h"
#include "engine/mt/multitriangulation.h"
#include "terrain/sight/line.h"

namespace arete {

/// What is nearer than this to an end of a line is not in its way, in metres: an antenna on a mast's top is
/// not hidden by the mast.
inline constexpr double kSightEndMetres = 1e-3;

/// A leg of a sight line in the space of a scene.
struct SceneLeg {
  Vec2 from, step;             ///< at t = 0, and how far it leads to t = 1
  double s0 = 0, ds = 0;       ///< distance along the ground
  double first = 0, last = 0;  ///< the range of distances that belongs to it
};

/// Where a line crosses triangles, in a scene whose heights relate to the line's by the z of a frame.
///
/// Per vertex the side of the leg is a function of the vertex alone, 0 counts as the left side, and the point
/// of an edge above the leg is computed from its right end to its left one: two triangles at an edge get the
/// same bits, so no line passes between them.
class LineCrossing {
 public:
  /// @param raised in the line's vertical unit: the line is raised by it.
  LineCrossing(const SightLine& line, const MetricFrame& frame, double raised)
      : line_(line), frame_(frame), raised_(raised) {}

  /// The first distance at which the line crosses a triangle above a leg. Not within kSightEndMetres of the
  /// ends. O(1).
  std::optional<double> along(const SceneLeg& leg, const std::array<Vec3, 3>& corners) const;
  /// Of a line between two heights at one place: the height, in the line's vertical unit.
  std::optional<double> upright(Vec2 place, const std::array<Vec3, 3>& corners) const;

 private:
  struct Point {
    double s, z;
  };
  double above(const Point& p) const { return line_.height(p.s) + raised_ - p.z; }
  double root(const Point& from, const Point& to) const;
  bool isAtAnEnd(double s) const;

  const SightLine& line_;
  const MetricFrame& frame_;
  double raised_;
};

}  // namespace arete
