// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "io/files/text/length_unit.h"
#include "terrain/model/georeference.h"

namespace arete {

// What the units of stated lengths are turned into.

/// The unit of heights, and of vertical errors. Not known where the source does not state it, or states what
/// does not measure lengths.
DataUnit heightUnitOf(const Georeference& georeference);

/// The metre of distances along the ground. Not known without a CRS, where they are in the units of the map.
DataUnit groundUnitOf(const Georeference& georeference);

/// The unit of distances in the space of a mesh. Known where its heights and its plan have the same unit: not
/// with a geographic CRS.
///
/// @param crsWkt, verticalUnit as the file states them; may be empty.
DataUnit spaceUnitOf(const std::string& crsWkt, const std::string& verticalUnit);

}  // namespace arete
