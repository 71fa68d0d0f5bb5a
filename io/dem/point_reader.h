// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "terrain/model/heightfield.h"

namespace arete {

struct PointReadOptions {
  std::string layer;  ///< of a file with several; not for text
  std::string
      zField;  ///< attribute or column that holds the height; empty = the geometry's z, or the column's name
  std::string crs;               ///< as for rasters
  std::optional<double> nodata;  ///< points of that height are left out, with a warning
};

struct PointRead {
  PointHeightfield heightfield;
  std::vector<std::string> warnings;
};

/// Reads scattered points: text (.csv, .tsv, .txt, .xyz, or any file that looks like it) or points and
/// multipoints of any vector format GDAL knows.
///
/// Text: one point a line; comma, semicolon, tab or spaces between the fields; '#', but for one in quotes,
/// opens a comment; the decimal sign is a point. A first line without any number names the columns: x or lon
/// or easting, y or lat or northing, z or elev or height (or PointReadOptions::zField) and their like;
/// without one, or with no name known, the first three are x, y, z.
///
/// Points in the order of the file; of equal points (x, y and z) the first is kept, with a warning that
/// counts them. The georeference is the identity: grid coordinates equal source coordinates.
///
/// Errors: notFound, unreadable, corrupt, unsupported (no point layer, several: listed; other geometries),
/// usage (no such column or field, not a CRS), invalidData (a line that does not parse, with its number; a
/// coordinate not finite; no point at all), degenerate (equal x, y and different z: names both), interrupted.
/// O(n log n); memory about 60 bytes per point.
Result<PointRead> readPoints(const std::string& path, const PointReadOptions& options = {},
                             const RunContext& context = {});

}  // namespace arete
