// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ogr_spatialref.h>

#include <span>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "terrain/model/georeference.h"

namespace arete {

/// The UTM zone of the middle of the longitudes and latitudes of some positions, on the datum of their CRS,
/// so that no datum is shifted. On the Earth the wider zones of Norway and Svalbard (31V to 32V, 31X to 37X)
/// count, as in the official grid.
///
/// Errors, with the culprit "toCrs utm": usage: no CRS, positions more than 3 degrees beyond the zone, south
/// of -80 or north of 84 degrees. unsupported: a prime meridian other than Greenwich. Those of CrsLonLat.
/// O(positions).
Result<OGRSpatialReference> utmOf(const Georeference& georeference, std::span<const Vec3> positions);

/// A zone of UTM: its number, and its longitudes in degrees.
struct UtmZone {
  int number = 1;
  double west = -180, east = -174;
};

/// @param longitude, latitude in degrees
/// @param hasWiderZones  the zones of Norway and Svalbard count
UtmZone utmZoneAt(double longitude, double latitude, bool hasWiderZones);

}  // namespace arete
