// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/warning.h"
#include "engine/parallel/run_context.h"
#include "io/geo/dem/point_reader.h"
#include "io/geo/dem/raster_reader.h"
#include "terrain/model/heightfield.h"
#include "terrain/model/source_reading.h"

namespace arete {

/// A raster or scattered points.
using DemHeightfield = std::variant<RasterHeightfield, PointHeightfield>;

struct DemRead {
  DemHeightfield heightfield;
  Warnings warnings;
};

/// Reads elevation data of any kind: a raster as readRaster() does, or scattered points as readPoints() does.
/// A folder, a pattern ("tiles/*.tif") and SourceReading::otherFiles stand for several rasters, which are
/// read as one (io/geo/dem/mosaic.h). A text whose points fill at least half of a regular grid becomes a
/// raster. The first column of a raster that goes round the Earth is repeated (io/geo/dem/seam_column.h), and
/// the scale of a map stated (io/geo/crs/map_scale.h). Warns of positions that look like degrees without a
/// CRS, and of positions outside the range of a geographic CRS.
///
/// Errors: those of readRasters(), readPoints() and demFilesOf(). usage: also a `reading` for the other kind
/// of data. unsupported: also point clouds (LAS, LAZ, COPC, E57); the message says what to do instead.
Result<DemRead> readDem(const std::string& path, const SourceReading& reading = {},
                        const RunContext& context = {});

/// As readDem(), but a text whose points fill a grid stays a set of points. Errors: as readDem(), for rasters
/// too.
Result<DemRead> readDemAsItIs(const std::string& path, const SourceReading& reading = {},
                              const RunContext& context = {});

}  // namespace arete
