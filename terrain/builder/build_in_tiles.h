// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "terrain/model/heightfield.h"
#include "terrain/model/terrain_model.h"
#include "terrain/simplify/tile_options.h"

namespace arete {

/// build() with the division into tiles stated, so that tests of small heightfields have many tiles. The MT
/// depends on `tiles`; build() passes TileOptions::of(options.shape). Errors: as build().
Result<TerrainModel> buildInTiles(const RasterHeightfield& heightfield, const BuildOptions& options,
                                  const TileOptions& tiles, const RunContext& context = {});
Result<TerrainModel> buildInTiles(const PointHeightfield& heightfield, const BuildOptions& options,
                                  const TileOptions& tiles, const RunContext& context = {});

}  // namespace arete
