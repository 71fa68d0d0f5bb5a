// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/criteria/region.h"
#include "engine/parallel/run_context.h"

namespace arete {

/// A region as a person stated it.
struct RegionArgument {
  RegionShape shape;  ///< in source coordinates; the distance is the argument's
  std::vector<std::string> warnings;
};

/// Reads a region: "xmin,ymin,xmax,ymax" in the DEM's CRS, or the name of a file of polygons, which are
/// reprojected into that CRS. With a distance, everything within it belongs to the region, and the file may
/// hold lines.
/// @param text      the box or the file
/// @param demCrs    WKT; empty if the DEM has no CRS. A CRS is never assumed: it is an error if only the file
///                  or only the DEM has one.
/// @param distance  metres on the ground; the DEM's units if it has no CRS
/// Errors: usage: an invalid box, a missing CRS, lines without a distance; those of readRegion().
Result<RegionArgument> readRegionArgument(const std::string& text, const std::string& demCrs,
                                          double distance = 0, const RunContext& context = {});

}  // namespace arete
