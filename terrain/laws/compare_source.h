// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "engine/base/result.h"
#include "terrain/model/heightfield.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// Compares every height of a model with the heightfield that it was built from, to the bit (0 and -0 are the
/// same; NODATA must be NODATA): position by position of a raster, as sets of x, y and z of points. Points
/// that repeat an earlier one may be missing in the model.
/// @return the number of heights compared
/// Errors: brokenPromise: the kind, the shape, the geotransform or a height differs; how many heights, and
/// the first of them. O(n log n).
Result<std::uint64_t> compareWithSource(const TerrainModel& model, const RasterHeightfield& source);
Result<std::uint64_t> compareWithSource(const TerrainModel& model, const PointHeightfield& source);

}  // namespace arete
