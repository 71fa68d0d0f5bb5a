// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gdal_priv.h>

#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"

namespace arete {

/// The samples of a band as heights, row by row. NaN is NODATA, as readRaster() defines it.
struct BandHeights {
  std::vector<double> heights;
  double scale = 1;  ///< height = raw * scale + offset
  double offset = 0;
};

/// Reads the whole band in strips of about a million samples.
///
/// @param nodata Replaces the declared NODATA value.
///
/// Errors: unsupported: complex samples. unreadable. invalidData: 64-bit integers beyond 2^53; an invalid
/// scale or offset. interrupted. May throw std::bad_alloc. Memory: 8 bytes per sample and one strip.
Result<BandHeights> readBandHeights(GDALRasterBand& band, std::optional<double> nodata,
                                    std::vector<std::string>& warnings, const RunContext& context);

}  // namespace arete
