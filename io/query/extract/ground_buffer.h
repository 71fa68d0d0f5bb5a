// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/warning.h"
#include "engine/criteria/region.h"
#include "engine/parallel/run_context.h"
#include "terrain/model/georeference.h"

namespace arete {

/// The largest distance of extendedOnGround(), in metres.
inline constexpr double kLargestGroundDistance = 1e6;

/// Extends a shape by its distance along the ground, in geodesic metres on the ellipsoid of the CRS
/// [Karney2013], whatever the scale of the map there. The result contains everything within the distance, and
/// nothing beyond 1.04 times it and 4 mm. Its x may leave -180..180; a pole within the distance belongs to
/// it.
///
/// @param shape In the coordinates of the CRS; its edges are straight there. A line of one vertex is a point.
/// @return Rings without a distance. The shape itself if its distance is 0, or if the CRS has no longitude
/// and latitude, as that of a building site.
///
/// Errors: usage: a distance above kLargestGroundDistance. invalidData: ground within the distance that the
/// CRS cannot tell. unsupported: GDAL without GEOS. interrupted. O(n log n) for n vertices and kilometres.
Result<RegionShape> extendedOnGround(const RegionShape& shape, const Georeference& georeference,
                                     Warnings& warnings, const RunContext& context = {});

}  // namespace arete
