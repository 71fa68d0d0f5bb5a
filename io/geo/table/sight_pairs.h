// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "engine/base/warning.h"
#include "engine/parallel/run_context.h"
#include "io/geo/crs/position_argument.h"
#include "io/geo/table/point_table.h"
#include "io/geo/text/point_attributes.h"
#include "terrain/model/georeference.h"

namespace arete {

/// One end of a sight line as a file states it.
struct SightSite {
  Vec2 stated;                         ///< as in the file; NaN if missing
  Vec2 xy;                             ///< in the DEM's CRS; NaN outside its domain
  std::optional<StatedHeight> height;  ///< nothing if missing
};

/// The beam of a site. NaN: missing in the file.
struct SightBeam {
  double azimuth = 0;    ///< of the middle, degrees clockwise from north
  double beamwidth = 0;  ///< horizontal, degrees
  double range = 0;      ///< metres
};

/// Sight lines to evaluate, with the attributes of their file: a row per line, in the order of the file.
struct SightPairs {
  std::vector<std::array<SightSite, 2>> rows;
  std::vector<SightBeam> beams;  ///< readSightSites(): one per row
  PointAttributes attributes;    ///< without the columns of the positions
  std::string crsWkt;            ///< of the stated positions; empty: unknown
  Warnings warnings;
};

/// Reads a layer of lines (their first and last vertices) or a table, CSV or any other that GDAL reads, with
/// the columns x1, y1, x2, y2 (or lon1, lat1, from_x, to_lon, ...; io/geo/text/column_rules.h). Without a
/// second position, as in a layer of points, the columns azimuth (degrees clockwise from north) and range
/// (metres) give it, along the geodesic. The columns h1 and h2 (from_height, to_height, ...) hold heights:
/// "30", "30agl", "120msl"; for points these are h, height or agl. The coordinates of a table are the DEM's,
/// or longitude and latitude; those of a layer are transformed from its CRS to the DEM's.
///
/// Errors: notFound, unreadable, unsupported, usage. invalidData: missing columns; a field that is not a
/// number or a range that is not above 0, with its row; no row. interrupted. O(rows).
Result<SightPairs> readSightPairs(const std::string& path, const Georeference& dem,
                                  const PointTableOptions& options = {}, const RunContext& context = {});

/// Reads points as readPointTable() does, as first ends, with their heights (columns h, height, agl, ...).
/// The second ends are NaN.
Result<SightPairs> readSightSites(const std::string& path, const Georeference& dem,
                                  const PointTableOptions& options = {}, const RunContext& context = {});

}  // namespace arete
