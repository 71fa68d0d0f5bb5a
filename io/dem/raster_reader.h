// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "terrain/model/heightfield.h"

namespace arete {

struct RasterReadOptions {
  /// Counted from 1. Not stated: band 1, except of a colour image, which is refused.
  std::optional<int> band;
  /// The CRS, in any form GDAL takes, where the file has none; where it has one, this replaces it, with a
  /// warning.
  std::string crs;
  /// The raw value that means "no data", instead of the one the band declares.
  std::optional<double> nodata;
};

struct RasterRead {
  RasterHeightfield heightfield;
  std::vector<std::string> warnings;
};

/// Reads one band of any raster GDAL knows. `path` may be a file, one of GDAL's virtual paths ("/vsizip/...",
/// "/vsicurl/...") or connection strings, or a zip archive that holds a single raster.
///
/// Heights: raw * scale + offset as the band declares them, in double. No data (NaN) is what equals the
/// declared or stated NODATA value (as a float where the samples are floats; within 1e-5 of it where it is
/// beyond 1e30, since its text is often rounded), what a dataset mask or an alpha band masks, NaN, and, with
/// a warning, what is infinite. A raster without geotransform, or with ground control points or RPCs only,
/// keeps the identity. The vertical unit is the band's, else that of the CRS's vertical axis; the vertical
/// datum that of a compound or three-dimensional CRS ("ellipsoid"), else the one in a DTED's metadata.
///
/// Errors: notFound, unreadable, corrupt, unsupported (not a raster, complex samples, a colour image,
/// subdatasets to choose from, 2^32 - 2 samples or more, more than this machine's memory), usage (no such
/// band, not a CRS), invalidData (a 64-bit height beyond 2^53, a geotransform without inverse), interrupted.
/// O(samples); memory 8 bytes per sample, one strip and GDAL's block cache (GDAL_CACHEMAX). Nothing is
/// printed.
Result<RasterRead> readRaster(const std::string& path, const RasterReadOptions& options = {},
                              const RunContext& context = {});

}  // namespace arete
