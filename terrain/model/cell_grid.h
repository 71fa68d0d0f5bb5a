// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "engine/base/result.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// A grid of square pixels, north up.
struct CellGrid {
  int columns = 0, rows = 0;
  std::array<double, 6> geoTransform{};  ///< from pixel to source coordinates; the first pixel is from 0 to 1
};

/// The grid of pixels of side `cell`, in source coordinates, that begins in the north-western corner of the
/// terrain and covers it: of a raster with the halves of pixels around the middles of the outer ones; of one
/// that goes round the Earth, its first column once.
/// Errors: usage: `cell` is not above 0, or there are more pixels in a row than an int numbers. O(1); for
/// points O(root vertices).
Result<CellGrid> cellGridOf(const TerrainModel& model, double cell);

}  // namespace arete
