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
  /// Counted from 1. Default: band 1, but a colour image is an error.
  std::optional<int> band;
  /// The CRS, in any form that GDAL accepts. Replaces the CRS of the file, with a warning. Empty: that of the
  /// file.
  std::string crs;
  /// The raw value that means NODATA, instead of the one that the band declares.
  std::optional<double> nodata;
};

struct RasterRead {
  RasterHeightfield heightfield;
  std::vector<std::string> warnings;
};

/// Reads one band of any raster that GDAL reads.
///
/// Heights are raw * scale + offset as the band declares them, in double. NODATA (NaN) is a raw value that
/// equals the declared or stated NODATA value (compared as floats for float samples; within 1e-5 of it beyond
/// 1e30, since its text is often rounded), a sample that a dataset mask or an alpha band masks, NaN, and,
/// with a warning, infinity. A raster without a geotransform, or with only ground control points or RPCs, has
/// the identity. The vertical unit is that of the band, otherwise that of the vertical axis of the CRS. The
/// vertical datum is that of a compound or three-dimensional CRS ("ellipsoid"), otherwise that in the
/// metadata of a DTED.
///
/// @param path A file, a virtual path ("/vsizip/...", "/vsicurl/...") or connection string of GDAL, or a zip
/// archive with a single raster.
///
/// Errors: notFound, unreadable, corrupt. unsupported: not a raster, complex samples, a colour image, several
/// subdatasets, 2^32 - 2 samples or more, more than the memory of the machine. usage: no such band; not a
/// CRS. invalidData: a 64-bit height beyond 2^53; a geotransform without inverse. interrupted. O(samples);
/// memory 8 bytes per sample, one strip and GDAL's block cache (GDAL_CACHEMAX). Prints nothing.
Result<RasterRead> readRaster(const std::string& path, const RasterReadOptions& options = {},
                              const RunContext& context = {});

}  // namespace arete
