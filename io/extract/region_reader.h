// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "engine/parallel/run_context.h"

namespace arete {

/// How readRegion() reads.
struct RegionReadOptions {
  std::string layer = {};   ///< required if the file has several
  std::string crs = {};     ///< replaces that of the layer; any text that GDAL accepts
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

/// Reads the polygons and multipolygons (and lines, if takesLines) of a layer of any vector format that GDAL
/// reads. Curves become straight edges. Polygons that overlap or touch are united, so that the even-odd rule
/// means inside any of them. If both the layer's CRS and `targetCrs` are known, the rings are reprojected, in
/// GIS axis order: an edge is split until its middle is within 1e-4 of its length from its reprojection.
/// Otherwise the coordinates are used as they are, with a warning if one of the two is known.
///
/// @param targetCrs  WKT or any text that GDAL accepts; empty = not known
/// Errors: notFound, unreadable, corrupt; unsupported: no such layer, or several (the message lists them);
/// invalidData: no polygon (or line, if takesLines), a vertex outside the target CRS; usage: not a CRS;
/// interrupted; outOfMemory. O(vertices log vertices).
Result<RegionRead> readRegion(const std::string& path, const std::string& targetCrs,
                              const RegionReadOptions& options = {}, const RunContext& context = {});

}  // namespace arete
