// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/files/existing_file.h"
#include "io/geo/polygons/cell_polygons.h"
#include "terrain/model/georeference.h"

namespace arete {

/// What the layer of polygons says beside their geometry.
struct PolygonFields {
  std::string layer;  ///< name of the layer
  std::string value;  ///< name of the field of whole numbers; empty: no such field
  /// What a value means, for the text field "answer"; empty: the field is left empty.
  std::function<std::string(double)> answer;
  /// Whether the number of this value is written; a value that stands for a word has no number.
  std::function<bool(double)> isNumber;
};

struct PolygonReport {
  std::uint64_t polygons = 0;
  bool hasAreas = false;  ///< whether the ground is known
};

/// Writes a raster as polygons into a layer of a GeoPackage (.gpkg): forCellPolygons(), with the fields
/// "answer", PolygonFields::value, "cells" and "area_m2" (GroundAreas; null where the ground is not known).
/// Coordinates are corners of cells in the CRS; without a position, columns and rows. The file appears
/// complete or not at all; an older one keeps its other layers, unless it is replaced.
///
/// Errors: usage: another kind of file. What writeGeoPackage() returns. O(forCellPolygons() + polygons).
Result<PolygonReport> writePolygons(const std::string& path, const CellValues& raster,
                                    const Georeference& georeference, const PolygonFields& fields,
                                    ExistingFile existing, const RunContext& context);

}  // namespace arete
