// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "engine/base/result.h"
#include "io/store/amt/file.h"

namespace arete {

/// The number of samples of the raster, NODATA included; 0 for points.
std::uint64_t amtGridSamples(const AmtFile& file);

/// Checks the checksum of one chunk. Precondition: the file has the chunk. Errors: corrupt. O(bytes).
Status checkAmtChunk(const AmtFile& file, const AmtTag& tag);

/// Checks the arrays beside the multitriangulation: isolated samples rise and are samples of the raster,
/// their heights are finite, fixed vertices exist. Errors: corrupt. O(their sizes).
Status checkAmtExtras(const AmtFile& file);

}  // namespace arete
