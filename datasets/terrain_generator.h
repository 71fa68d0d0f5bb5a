// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "terrain/model/heightfield.h"

namespace arete {

struct TerrainOptions {
  std::uint32_t columns = 1025;
  std::uint32_t rows = 1025;
  std::uint64_t seed = 1;
  double pixelMetres = 30;
  bool sea = true;   ///< a coast on one side: sea at exactly 0
  bool lake = true;  ///< a lake behind a moraine, as NODATA
};

/// Mountains that rivers have carved: uplift against stream-power incision and hillside diffusion
/// [BraunWillett2013], from a coarse grid to a fine one, so that the large valleys are old and the small ones
/// young.
///
/// Heights are metres in whole 64ths (exact as float), valid everywhere but in the lake; the CRS is UTM 32
/// north. The same options give the same bits on every machine, for any number of threads.
///
/// Errors: usage (fewer than 16 or more than 16385 columns or rows, a pixel size that is not positive),
/// interrupted (cancelled). About 2.5 microseconds and 60 bytes a sample.
Result<RasterHeightfield> generateTerrain(const TerrainOptions& options, const RunContext& context = {});

}  // namespace arete
