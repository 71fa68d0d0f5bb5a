// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/warning.h"
#include "engine/criteria/region.h"
#include "engine/parallel/run_context.h"
#include "io/geo/crs/longitude_turns.h"
#include "terrain/model/georeference.h"

namespace arete {

/// How a person states a region.
struct RegionText {
  std::string text;     ///< "xmin,ymin,xmax,ymax", or the name of a file of polygons
  double distance = 0;  ///< the region is extended by it: metres on the ground; the DEM's units without a CRS
  std::string crs = {};  ///< of the box or the file; empty: the DEM's for a box, the file's own for a file
};

/// A region as a person stated it.
struct RegionArgument {
  RegionShape shape;  ///< in source coordinates
  Warnings warnings;
};

/// How a program states a region: in the DEM's CRS.
struct StatedRegion {
  std::optional<std::array<double, 4>> box = {};  ///< xmin, ymin, xmax, ymax; comes before the polygons
  std::vector<std::vector<std::vector<Vec2>>> polygons = {};  ///< each its outer ring and its holes
};

/// Brings a region onto the DEM: adds a copy for each whole turn by which it meets it. Where there are
/// several, or the shape is longer than a turn, they are united.
void turnOnto(const LongitudeTurns& turns, RegionArgument& region);

/// Reads a region: a box, or a file of polygons, which are reprojected into the DEM's CRS. With a distance,
/// everything within it belongs to the region, and the file may hold lines and points. A box whose xmin is
/// above its xmax crosses the antimeridian, as in [RFC7946], where x are longitudes.
///
/// The shape lies where the DEM lies: parts that are whole turns away are brought onto it, once for each
/// place where they meet it. Its distance is 0, and the ground within the distance is part of its rings
/// (io/query/extract/ground_buffer.h), unless the DEM's CRS has no longitude and latitude.
///
/// @param dem  Of the DEM. A CRS is never assumed: it is an error if only the file or only the DEM has one.
/// @param turns  Onto the DEM.
/// Errors: usage: an invalid box, a missing CRS, lines without a distance; those of readRegion() and of
/// extendedOnGround().
Result<RegionArgument> readRegionArgument(const RegionText& region, const Georeference& dem,
                                          const LongitudeTurns& turns, const RunContext& context = {});

/// Makes the region that readRegionArgument() makes of the same box, or of a file of the same polygons.
///
/// Errors: usage: an invalid box, or an error of regionOf(). The culprit is "region".
Result<RegionArgument> regionArgumentOf(const StatedRegion& region, const Georeference& dem,
                                        const LongitudeTurns& turns);

}  // namespace arete
