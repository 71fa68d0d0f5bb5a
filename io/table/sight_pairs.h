// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "engine/parallel/run_context.h"
#include "io/crs/position_argument.h"
#include "io/table/point_attributes.h"
#include "io/table/point_table.h"
#include "terrain/model/georeference.h"

namespace arete {

/// One end of a line of sight as a file states it.
struct SightSite {
  Vec2 stated;                         ///< as the file has it; NaN where it has none
  Vec2 xy;                             ///< in the DEM's CRS; NaN where it cannot tell the place
  std::optional<StatedHeight> height;  ///< nothing where the file has none
};

/// Where a site looks, as far as its file says it: NaN where it does not.
struct SightBeam {
  double azimuth = 0;    ///< of the middle, degrees clockwise from north
  double beamwidth = 0;  ///< horizontal, degrees
  double range = 0;      ///< metres
};

/// Lines of sight to ask about, with all that their file says of them: one row per line, in the order of the
/// file.
struct SightPairs {
  std::vector<std::array<SightSite, 2>> rows;
  std::vector<SightBeam> beams;  ///< readSightSites(): one per row
  PointAttributes attributes;    ///< without the columns that places came from
  std::string crsWkt;            ///< of the stated places; empty = not known
  std::vector<std::string> warnings;
};

/// Reads a layer of lines (their first and last vertices), or a table, CSV or any that GDAL reads, with the
/// columns x1, y1, x2, y2 (or lon1, lat1, from_x, to_lon, ...). Where there is no second place, as for a
/// layer of points, the columns azimuth (degrees clockwise from north) and range (metres) say where it is,
/// along the geodesic. The columns h1 and h2 (from_height, to_height, ...) hold heights, "30", "30agl",
/// "120msl"; of points, h, height or agl. A table's coordinates are the DEM's, or longitude and latitude; a
/// layer's are brought from its CRS into the DEM's. Errors: notFound, unreadable, unsupported, usage,
/// invalidData (no such columns; a field that is no number, a range not above 0, with its row; no row at
/// all), interrupted.
/// O(rows).
Result<SightPairs> readSightPairs(const std::string& path, const Georeference& dem,
                                  const PointTableOptions& options = {}, const RunContext& context = {});

/// Reads points as readPointTable() does, with their heights (columns h, height, agl, ...), as first ends;
/// the second ends are left open.
Result<SightPairs> readSightSites(const std::string& path, const Georeference& dem,
                                  const PointTableOptions& options = {}, const RunContext& context = {});

}  // namespace arete
