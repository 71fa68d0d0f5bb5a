// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "terrain/model/terrain_model.h"
#include "terrain/sight/paths.h"

namespace arete {

/// Reads the height of what stands on the terrain, such as trees and buildings.
///
/// @param text A number, "12.5", for a uniform height, or the path of a raster of heights in the CRS of the
/// DEM, up to whole turns of longitude. A position has the height of its pixel, and 0 on NODATA or outside
/// the raster. Heights are in the DEM's vertical unit unless the raster states another.
/// @param model May be destroyed after the call.
///
/// Errors: usage: a negative height; another CRS; a raster that does not overlap the DEM. Also those of
/// readRaster().
Result<SightClutter> readClutter(const std::string& text, const TerrainModel& model,
                                 const RunContext& context = {});

}  // namespace arete
