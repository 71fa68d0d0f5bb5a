// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "engine/base/warning.h"
#include "io/geo/gdal/support.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// A virtual raster of an image in longitudes and latitudes, shifted by whole turns onto a geographic DEM. An
/// image that goes round the Earth is repeated where the DEM needs two copies of it. Of another one, which
/// two copies would leave a gap between, the copy with the larger part on the DEM is taken, with a warning.
///
/// @param picture Outlives the result.
/// @return null where the image itself is right: it meets the DEM where it lies and nowhere else, or nowhere,
/// or it or the DEM is not in longitudes and latitudes, or its rows do not run along the parallels.
GdalDatasetPtr turnedOnto(GDALDataset& picture, const TerrainModel& model, Warnings& warnings);

}  // namespace arete
