// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "engine/mt/multitriangulation.h"

namespace arete {

/// New positions for the vertices of a multitriangulation, by a map that bends the plan (onto the ellipsoid).
/// Points above one another stay on a straight line, at the same distances.
struct Bending {
  std::vector<Vec2> plan;       ///< of every vertex
  std::vector<double> heights;  ///< of every vertex; metric.toMetric() maps plan and height to metric space
  MetricFrame metric;           ///< x and y to the same scale; z: metric units of one unit of height
  MetricFrame flat;             ///< frame of the positions before; its z scale is that of `metric`

  /// Bounds of the map's derivatives in the flat metric space: of its second derivative along a line of the
  /// plan, and of the turn of the vertical per unit of length.
  double curvature = 0, turning = 0;
};

/// The same multitriangulation with its vertices at these positions, for saturated cuts by a view (ViewError,
/// ViewMesh). The plane of a triangle leaves the curved ground by up to curvedAway(), which is added to its
/// error: the error bounds the distance between the image of a sample and the corresponding point of the
/// triangle, in units of height and in any direction. Spheres and saturated errors are computed anew, so that
/// law 6 holds.
///
/// Limits: nodes are no longer in falling bands of errors, triangles may lose their positive orientation in
/// plan, and there are no signed bounds (kBelow and kAbove are empty). So uniform criteria, minimal cuts
/// and lines of sight are not possible.
///
/// Keeps the given one alive. Memory: 43 bytes per node and 2 per triangle. O(size). Preconditions: positions
/// are finite; the numbers of Bending are finite and >= 0, the scales > 0.
MultiTriangulation curved(const MultiTriangulation& mt, Bending bending);

/// An upper bound of the distance, in metric units, between the curved ground and the plane of a curved
/// triangle.
/// @param a,b,c Its corners in the flat metric space.
double curvedAway(const Bending& bending, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace arete
