// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "engine/result.h"
#include "engine/run_context.h"
#include "engine/vec.h"

namespace arete {

struct RegionArgument {
  std::vector<std::vector<Vec2>> rings;  ///< in source coordinates; inside by the even-odd rule
  std::vector<std::string> warnings;
};

/// A region as a person states it: "xmin,ymin,xmax,ymax" in the DEM's CRS, or a file of polygons, which are
/// reprojected into it. `demCrs`: WKT; empty where the DEM has none. A CRS is never assumed: a file with one
/// and a DEM without, or the other way round, is an error. Errors: usage (a box that is none, a missing CRS),
/// and those of readRegion().
Result<RegionArgument> readRegionArgument(const std::string& text, const std::string& demCrs,
                                          const RunContext& context = {});

}  // namespace arete
