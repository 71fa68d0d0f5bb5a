// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "terrain/model/heightfield.h"

namespace arete {

/// The raster these points are the samples of, if they are: x and y on regular steps to 1 percent of a step
/// (text is rounded), at least two columns and rows, at least half of the cells taken, and most points beside
/// two others of one cell. North up; a missing cell is NaN. O(n log n).
std::optional<RasterHeightfield> asRaster(const PointHeightfield& points);

}  // namespace arete
