// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/warning.h"
#include "engine/parallel/run_context.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// The grid of a raster, and the positions of its samples in the plan of a model.
struct PlacedGrid {
  std::uint32_t columns = 0, rows = 0;
  Georeference georeference;
  std::vector<Vec2> places;  ///< row by row; NaN outside the domain of the DEM's CRS
};

/// Reads the grid of a raster. Its values do not matter, so it may be an image. Precondition: the model is of
/// a raster.
///
/// Errors: those of readRaster() for its first band, and of CrsTransform. invalidData: only one of the two
/// has a CRS. usage: no sample is within the borders of the model. O(samples).
Result<PlacedGrid> readPlacedGrid(const std::string& path, const TerrainModel& model, Warnings& warnings,
                                  const RunContext& context = {});

}  // namespace arete
