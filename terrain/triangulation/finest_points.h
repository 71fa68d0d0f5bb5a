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
/// metric that stretches x, laid out along the ground.
struct FinestPoints {
  std::vector<std::uint32_t> order;  ///< the points, those near each other near each other (groundOrder())
  /// Corners by their places in `order`, counter-clockwise from the least; by rising corners. Points that
  /// repeat an earlier one exactly (x, y and z) are left out.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  double xStretch = 1;  ///< of the metric, a power of two

  /// The triangles by point indices, in no order.
  std::vector<std::array<std::uint32_t, 3>> trianglesOfPoints() const;
};

/// In the metric of pointMetricStretch(). Whoever asks for more than one thing that rests on it
/// (chooseFixedVertices(), build()) can have it once. Errors: invalidData; unsupported where there are too
/// many points; degenerate when two points share x, y and not z (names both), when there is no triangle;
/// interrupted. O(n log n) expected.
Result<FinestPoints> finestPoints(const PointHeightfield& heightfield, const RunContext& context = {});

/// The power of two nearest to the ground aspect (x step over y step) at the centre of the points: 1 for a
/// projected CRS.
double pointMetricStretch(const PointHeightfield& heightfield);

}  // namespace arete
