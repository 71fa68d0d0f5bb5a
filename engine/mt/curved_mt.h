// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "engine/mt/multitriangulation.h"

namespace arete {

/// New places for the vertices of a multitriangulation: where a map that takes straight lines to curves puts
/// them. Heights above one place stay on a straight line, and as far apart as they were.
struct Bending {
  std::vector<Vec2> plan;       ///< of every vertex
  std::vector<double> heights;  ///< of every vertex; metric.toMetric() makes them places
  MetricFrame metric;           ///< x and y to the same scale; z: metric units of one unit of height
  MetricFrame flat;             ///< of the places as they are; its z scale is that of `metric`

  /// Bounds of the map's second derivatives in the flat metric space: how much, per unit of length squared,
  /// it bends along a line of the plan, and how much the vertical turns per unit of length.
  double curvature = 0, turning = 0;
};

/// The same multitriangulation with its vertices at these places, for saturated cuts by a view (ViewError,
/// ViewMesh). Straight triangles no longer follow the ground: the error of each has grown by what its plane
/// can miss of the curved one, so it bounds the distance between the place where the map puts a sample and
/// the place of the triangle that stands for it, in units of height and in whatever direction. Spheres and
/// saturated errors are made anew, and law 6 holds.
///
/// What it is not good for: nodes are no longer in falling bands of errors, triangles that were positively
/// oriented in plan need not be, and there are no signed bounds (`below` and `above` are empty). So no
/// uniform criterion, no minimal cut, no line of sight.
///
/// Keeps the given one alive. 43 bytes per node and 2 per triangle. O(size), children before parents.
/// Preconditions: places are finite; the numbers of Bending are finite and >= 0, the scales > 0.
MultiTriangulation curved(const MultiTriangulation& mt, Bending bending);

/// By how much at most, in metric units, the curved ground leaves the plane of a curved triangle, given its
/// corners in the flat metric space.
double curvedAway(const Bending& bending, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace arete
