// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "terrain/model/heightfield.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// Consecutive rows of a raster, both included.
struct ModelRows {
  std::uint32_t first = 0, last = 0;
};

/// The samples of these rows, as TerrainModel::rasterSamples() has them. Precondition: a raster; `last` is
/// one of its rows, and not before `first`. O(vertices of the model + samples of the rows).
RasterHeightfield samplesInRows(const TerrainModel& model, const ModelRows& rows);

}  // namespace arete
