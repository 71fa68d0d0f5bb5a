// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "terrain/model/terrain_model.h"
#include "terrain/sight/paths.h"

namespace arete {

/// What stands on the terrain: "12.5", everywhere, or a raster of heights in the CRS of the DEM, taken pixel
/// by pixel, any whole turn of longitude away; NODATA and what is outside of it has none. Heights are in the
/// DEM's vertical unit unless the raster states another. The result reads the model's georeference only while
/// this runs. Errors: usage (a negative height; another CRS; nothing of it over the DEM), and those of
/// readRaster().
Result<SightClutter> readClutter(const std::string& text, const TerrainModel& model,
                                 const RunContext& context = {});

}  // namespace arete
