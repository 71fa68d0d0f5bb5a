// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "engine/base/warning.h"
#include "engine/parallel/run_context.h"

namespace arete {

/// Plan positions as read.
struct PlanPoints {
  std::vector<Vec2> positions;  ///< in the target CRS, in the order of the file
  Warnings warnings;
};

/// Reads plan positions and ignores heights: from text as for readPoints(), where two columns suffice, or
/// from the points and multipoints of any vector format of GDAL with one such layer. The coordinates of a
/// text are in the target CRS; those of a layer are transformed to it.
///
/// @param targetCrs WKT or any text that GDAL accepts; empty: unknown.
///
/// Errors: notFound, unreadable, unsupported. invalidData: a position that is not finite or outside the
/// domain of the target CRS; a layer with a CRS and a target without; no point. interrupted. O(points).
Result<PlanPoints> readPlanPoints(const std::string& path, const std::string& targetCrs,
                                  const RunContext& context = {});

}  // namespace arete
