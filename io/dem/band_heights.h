// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gdal_priv.h>

#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"

namespace arete {

/// The samples of a band as heights, row by row, NaN = no data; see readRaster() for what counts as that.
struct BandHeights {
  std::vector<double> heights;
  double scale = 1;  ///< height = raw * scale + offset
  double offset = 0;
};

/// Reads the whole band in strips of about a million samples. `nodata` replaces the declared value if stated.
/// Errors: unsupported (complex samples), unreadable, invalidData (64-bit integers beyond 2^53; no usable
/// scale), interrupted. May throw std::bad_alloc. Memory: 8 bytes per sample and one strip.
Result<BandHeights> readBandHeights(GDALRasterBand& band, std::optional<double> nodata,
                                    std::vector<std::string>& warnings, const RunContext& context);

}  // namespace arete
