// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/result.h"
#include "terrain/heightfield.h"

namespace arete {

/// The finest triangulation of scattered points: their Delaunay triangulation (CGAL, exact predicates) in the
/// metric that stretches x by xStretch. Corners are point indices, counter-clockwise. The list is in an order
/// that depends on the points alone. Points that repeat an earlier one exactly (x, y and z) are left out.
/// Errors: degenerate when two points share x, y and not z (names both), when there is no triangle.
/// O(n log n) expected. Precondition: xStretch is a power of two.
Result<std::vector<std::array<std::uint32_t, 3>>> finestTriangulation(const PointHeightfield& heightfield,
                                                                      double xStretch);

/// The power of two nearest to the ground aspect (x step over y step) at the centre of the points: 1 for a
/// projected CRS.
double pointMetricStretch(const PointHeightfield& heightfield);

}  // namespace arete
