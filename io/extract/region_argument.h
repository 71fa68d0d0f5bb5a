// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/criteria/region.h"
#include "engine/parallel/run_context.h"

namespace arete {

struct RegionArgument {
  RegionShape shape;  ///< in source coordinates; the distance is the argument's
  std::vector<std::string> warnings;
};

/// A region as a person states it: "xmin,ymin,xmax,ymax" in the DEM's CRS, or a file of polygons, which are
/// reprojected into it. With a distance, all that is as near belongs to it, and the file's lines count, too.
/// `demCrs`: WKT; empty where the DEM has none. `distance` in metres on the ground, or in the DEM's units
/// without a CRS. A CRS is never assumed: a file with one and a DEM without, or the other way round, is an
/// error. Errors: usage (a box that is none, a missing CRS), and those of readRegion().
Result<RegionArgument> readRegionArgument(const std::string& text, const std::string& demCrs,
                                          double distance = 0, const RunContext& context = {});

}  // namespace arete
