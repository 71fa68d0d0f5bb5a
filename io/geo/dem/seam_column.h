// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "terrain/model/heightfield.h"

namespace arete {

/// Repeats the first column of a raster behind its last one, if the raster goes round the Earth: a geographic
/// CRS, columns along the parallels, and as many of them as a turn has, within a twentieth of a column. Then
/// the ground between the last column and the first is terrain like any other. Sets
/// Georeference::repeatsFirstColumn and the checksum. O(size) then, otherwise O(1).
///
/// @return whether it did. Not where the last column is the first already, as in grids of whole degrees from
/// -180 to 180.
bool repeatFirstColumn(RasterHeightfield& raster);

}  // namespace arete
