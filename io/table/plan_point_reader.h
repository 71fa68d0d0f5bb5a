// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "engine/parallel/run_context.h"

namespace arete {

struct PlanPoints {
  std::vector<Vec2> positions;  ///< in the target CRS, in the order of the file
  std::vector<std::string> warnings;
};

/// Reads plan positions, heights or none: text as readPoints() takes it (where two columns do), or points and
/// multipoints of any vector format GDAL knows (of a file with one such layer). A text's coordinates are in
/// the target CRS; a layer's are reprojected into it. `targetCrs`: WKT or any text GDAL takes; empty = not
/// known. Errors: notFound, unreadable, unsupported, invalidData (a position that is not finite, or that the
/// target CRS cannot tell; a layer with a CRS where the target has none), interrupted. O(points).
Result<PlanPoints> readPlanPoints(const std::string& path, const std::string& targetCrs,
                                  const RunContext& context = {});

}  // namespace arete
