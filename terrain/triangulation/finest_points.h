// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "terrain/model/heightfield.h"

namespace arete {

/// The finest triangulation of scattered points: their Delaunay triangulation (CGAL, exact predicates) in a
/// metric that stretches x, in an order along the ground.
struct FinestPoints {
  std::vector<std::uint32_t> order;  ///< the points along the ground (groundOrder())
  /// Corners as indices into `order`, counter-clockwise from the least; sorted by corners. Points that repeat
  /// an earlier one exactly (x, y and z) are left out.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  double xStretch = 1;  ///< of the metric, a power of two

  /// The triangles with point indices as corners, in no particular order.
  std::vector<std::array<std::uint32_t, 3>> trianglesOfPoints() const;
};

/// Computes it in the metric of pointMetricStretch(). A caller of several functions that need it
/// (chooseFixedVertices(), build()) computes it once and passes it. O(n log n) expected.
/// Errors: invalidData: a coordinate is not finite. unsupported: too many points for 32-bit ids. degenerate:
/// two points share x and y but not z (the message names both), or there is no triangle. interrupted.
Result<FinestPoints> finestPoints(const PointHeightfield& heightfield, const RunContext& context = {});

/// The power of two nearest to the ground aspect (ground length of one unit of x over that of y) at the
/// centre of the points: 1 for a projected CRS.
double pointMetricStretch(const PointHeightfield& heightfield);

}  // namespace arete
