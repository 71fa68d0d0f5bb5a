// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "engine/base/warning.h"
#include "engine/parallel/run_context.h"
#include "io/geo/text/point_attributes.h"
#include "terrain/model/georeference.h"

namespace arete {

/// Query points with the attributes of their file: a row per point, in the order of the file.
struct PointTable {
  std::vector<Vec2> stated;              ///< as in the file; NaN where x or y is missing
  std::vector<double> z;                 ///< of the points themselves, NaN without; empty where none has one
  std::string xName = "x", yName = "y";  ///< of their columns in a text that has names
  std::string crsWkt;                    ///< of `stated`; empty: unknown
  std::vector<Vec2> positions;           ///< in the DEM's CRS; NaN without a position or outside its domain
  PointAttributes attributes;            ///< without the columns of x and y
  std::uint64_t withoutPlace = 0;        ///< rows without a position
  Warnings warnings;
};

struct PointTableOptions {
  std::string layer{};  ///< needed if a file has several
  bool lonLat = false;  ///< coordinates without a CRS are longitude, latitude in degrees (WGS 84)
};

/// Reads points and their attributes: from text as for readPoints(), where two columns suffice, or from the
/// points and multipoints of any vector format of GDAL, a row per point, with the feature's id in the column
/// "source_fid". The coordinates of a text are the DEM's, or longitude and latitude, or in the CRS that its
/// EWKT states; those of a layer are transformed from its CRS to the DEM's. Rows without a position stay.
///
/// Errors: notFound, unreadable, unsupported. corrupt: a part of the file is missing. usage: options.lonLat
/// and a DEM without a CRS. invalidData: a line that does not parse, with its number; a layer with a CRS and
/// a DEM without; no row. interrupted. O(points).
Result<PointTable> readPointTable(const std::string& path, const Georeference& dem,
                                  const PointTableOptions& options = {}, const RunContext& context = {});

}  // namespace arete
