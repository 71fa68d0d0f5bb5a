// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/dem/point_reader.h"
#include "io/dem/raster_reader.h"
#include "terrain/model/heightfield.h"
#include "terrain/model/source_reading.h"

namespace arete {

using DemHeightfield = std::variant<RasterHeightfield, PointHeightfield>;

struct DemRead {
  DemHeightfield heightfield;
  std::vector<std::string> warnings;
};

/// The one door for elevation data: reads a raster or scattered points, whichever the file is; see
/// readRaster() and readPoints() for how and for the errors. Text whose points fill a regular grid, at least
/// by half, is a raster (and its heights stay doubles). A reading of the other kind is refused (usage).
/// Places that look like degrees without a CRS, or that no globe has under one of degrees, are warned of.
/// LAS, LAZ, COPC and E57 clouds are refused with what to do instead (unsupported).
Result<DemRead> readDem(const std::string& path, const SourceReading& reading = {},
                        const RunContext& context = {});

}  // namespace arete
