// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "terrain/model/heightfield.h"

namespace arete {

/// Detects points that are the samples of a raster: x and y on regular steps within 1 percent of a step
/// (texts are rounded), at least two columns and rows, at least half of the samples present, and most points
/// in a cell with at least three.
///
/// @return The raster, north up, NaN for missing samples; nothing if the points are scattered. O(n log n).
std::optional<RasterHeightfield> asRaster(const PointHeightfield& points);

}  // namespace arete
