// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "engine/base/warning.h"
#include "engine/parallel/run_context.h"

namespace arete {

/// How readRegion() reads.
struct RegionReadOptions {
  std::string layer = {};    ///< required if the file has several
  std::string crs = {};      ///< replaces that of the layer; any text that GDAL accepts
  bool takesLines = false;   ///< lines are part of the region, not only polygons
  bool takesPoints = false;  ///< points as well
};

/// The union of the polygons of a file, as rings, its lines and its points.
struct RegionRead {
  /// The rings of all polygons, holes among them: a position is inside by the even-odd rule over all of them.
  /// Each ring has three vertices at least and is closed by the edge from its last to its first.
  std::vector<std::vector<Vec2>> rings;
  std::vector<std::vector<Vec2>> lines;  ///< of two vertices at least
  std::vector<Vec2> points;
  bool lacksCrs = false;  ///< one of the two CRSs is missing and the other is there
  Warnings warnings;
};

/// Reads the polygons and multipolygons (and lines and points, where they are taken) of a layer of any vector
/// format that GDAL reads. Curves become straight edges. Polygons that cross themselves cover all that their
/// rings go around; those that overlap or touch are united, also across the antimeridian, so that the
/// even-odd rule means inside any of them. If both the layer's CRS and `targetCrs` are known, the rings are
/// reprojected, in GIS axis order: an edge is split until its quarters are within 1e-4 of its length from its
/// reprojection. Where the target's x are longitudes they are continuous along a ring, which may leave
/// -180..180, and a ring around a pole is led over it. Otherwise the coordinates are used as they are, with a
/// warning if one of the two is known.
/// An edge of a polygon over more than half a turn of longitudes is taken as it is drawn, with a warning; one
/// of a line is led the short way.
///
/// @param targetCrs  WKT or any text that GDAL accepts; empty = not known
/// Errors: notFound, unreadable; corrupt, also where a part of the file is missing; unsupported: no such
/// layer, or several (the message lists them); invalidData: no polygon (or line or point, where they are
/// taken), a vertex outside the target CRS, an edge that a seam of the target tears, a target that is no CRS;
/// usage: options.crs is no CRS; interrupted; outOfMemory. O(vertices log vertices).
Result<RegionRead> readRegion(const std::string& path, const std::string& targetCrs,
                              const RegionReadOptions& options = {}, const RunContext& context = {});

/// Makes a region of polygons of a program as readRegion() makes one of those of a file: those that cross
/// themselves cover all that their rings go around, and those that overlap, lie in one another or occur twice
/// are united.
///
/// @param polygons Each is its outer ring and its holes, closed or not. One without an outer ring of three
/// vertices is empty.
/// @param crs In which they are; empty: not known. Says whether x are longitudes.
/// Errors: invalidData: no polygon with an area, a vertex that is not finite; outOfMemory. O(vertices log
/// vertices).
Result<RegionRead> regionOf(const std::vector<std::vector<std::vector<Vec2>>>& polygons,
                            const std::string& crs);

/// Reprojects a ring, which its last and first vertex close, as readRegion() does. Errors: as of
/// readRegion().
Result<std::vector<Vec2>> reprojectRing(const std::vector<Vec2>& ring, const std::string& fromCrs,
                                        const std::string& toCrs);

}  // namespace arete
