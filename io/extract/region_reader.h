// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "engine/parallel/run_context.h"

namespace arete {

struct RegionReadOptions {
  std::string layer = {};   ///< of a file with several
  std::string crs = {};     ///< as for rasters
  bool takesLines = false;  ///< lines are part of the region, not only polygons
};

/// The union of the polygons of a file, as rings, and its lines.
struct RegionRead {
  /// The rings of all polygons, holes among them: a position is inside by the even-odd rule over all of them.
  /// Each ring has three vertices at least and is closed by the edge from its last to its first.
  std::vector<std::vector<Vec2>> rings;
  std::vector<std::vector<Vec2>> lines;  ///< of two vertices at least
  bool lacksCrs = false;                 ///< one of the two CRSs is missing and the other is there
  std::vector<std::string> warnings;
};

/// Reads the polygons and multipolygons, and on request the lines, of a layer of any vector format GDAL knows
/// (curves are made straight). Polygons that overlap or touch are united, so that even-odd means inside any
/// of them. Where the layer's CRS and `targetCrs` (WKT or any text GDAL takes; empty = not known) are both
/// known, the rings are reprojected into it, in GIS axis order: an edge is split until its middle is within
/// 1e-4 of its length from where the reprojection puts it. Where one of the two is missing the coordinates
/// are taken as they are, with a warning if the other is there.
///
/// Errors: notFound, unreadable, corrupt, unsupported (no such layer, or several: listed), invalidData (no
/// polygon, nor a line where lines count; a vertex outside the target CRS), usage (not a CRS), interrupted.
/// O(vertices log vertices).
Result<RegionRead> readRegion(const std::string& path, const std::string& targetCrs,
                              const RegionReadOptions& options = {}, const RunContext& context = {});

}  // namespace arete
