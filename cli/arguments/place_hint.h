// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "engine/base/vec.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// What to say of a place that looks like longitude and latitude where the map of the DEM has lengths:
/// "longitude, latitude? add --lonlat". The other order is recognised as well.
///
/// @param place as it is stated, in the DEM's CRS for all that is known.
/// @param model its root is enough.
/// @return empty where the DEM has no CRS or one of degrees, where the place is on the DEM's box, and where
/// its numbers are too large for degrees. O(1) for rasters, O(root vertices) for points.
std::string degreesHint(Vec2 place, const TerrainModel& model);

/// The same of a box, of which --lonlat says nothing: "add --region-crs EPSG:4326".
std::string degreesHint(const Box2& box, const TerrainModel& model);

/// "; hint", or nothing.
std::string behindSemicolon(const std::string& hint);

}  // namespace arete
