// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "engine/parallel/run_context.h"
#include "io/table/point_attributes.h"
#include "terrain/model/georeference.h"

namespace arete {

/// Places to ask about, with all that their file says of them: one row per point, in the order of the file.
struct PointTable {
  std::vector<Vec2> stated;     ///< as the file has them; NaN for a feature without a position
  std::string crsWkt;           ///< of `stated`; empty = not known
  std::vector<Vec2> positions;  ///< in the DEM's CRS; NaN where it cannot tell the place
  PointAttributes attributes;   ///< without the columns that x and y came from
  std::vector<std::string> warnings;
};

struct PointTableOptions {
  std::string layer{};  ///< of a file with several
  bool lonLat = false;  ///< coordinates without a CRS are longitude, latitude in degrees (WGS 84)
};

/// Reads points and their attributes: text as readPoints() takes it (where two columns do), or points and
/// multipoints of any vector format GDAL knows, one row per point, with the feature's id as "source_fid". A
/// text's coordinates are the DEM's, or longitude and latitude; a layer's are brought from its CRS into the
/// DEM's. Errors: notFound, unreadable, unsupported, usage (lonLat and a DEM without a CRS), invalidData (a
/// line that does not parse, with its number; a layer with a CRS and a DEM without; no point at all),
/// interrupted. O(points).
Result<PointTable> readPointTable(const std::string& path, const Georeference& dem,
                                  const PointTableOptions& options = {}, const RunContext& context = {});

}  // namespace arete
