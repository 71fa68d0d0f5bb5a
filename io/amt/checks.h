// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "engine/base/result.h"
#include "io/amt/file.h"

namespace arete {

/// Samples of the raster, whether they hold data or not. 0 of points.
std::uint64_t amtGridSamples(const AmtFile& file);

/// The checksum of one chunk. Errors: corrupt. Precondition: there is such a chunk.
Status checkAmtChunk(const AmtFile& file, const AmtTag& tag);

/// What stands beside the multitriangulation: isolated samples rise and are samples of the raster, their
/// heights are finite, fixed vertices exist. Errors: corrupt. O(these).
Status checkAmtExtras(const AmtFile& file);

}  // namespace arete
