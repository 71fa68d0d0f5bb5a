// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/warning.h"
#include "engine/parallel/run_context.h"
#include "terrain/model/heightfield.h"

namespace arete {

struct RasterReadOptions {
  /// Counted from 1. Default: band 1, but a colour image is an error.
  std::optional<int> band;
  /// The CRS, in any form that GDAL accepts. Replaces the CRS of the file, with a warning. Empty: that of the
  /// file.
  std::string crs;
  /// The raw value that means NODATA, instead of the one that the band declares. NaN: NaN alone.
  std::optional<double> nodata;
  std::string
      verticalUnit;  ///< "m", "ft", "us-ft", ...; replaces what the file says. Empty: that of the file
  std::optional<bool> isDepth;  ///< whether the values count downwards, whatever the file says
};

struct RasterRead {
  RasterHeightfield heightfield;
  Warnings warnings;
};

/// Reads one band of any raster that GDAL reads.
///
/// Heights are raw * scale + offset as the band declares them, in double, and count upwards: depths are
/// negated, with a warning (io/geo/crs/vertical.h). NODATA (NaN) is a raw value that equals the declared or
/// stated NODATA value (compared as floats for float samples; within 1e-5 of it beyond 1e30, since its text
/// is often rounded), a sample that a mask or an opacity of 0 hides, NaN, and, with a warning, infinity and a
/// sample in a block that a sparse file leaves out. The vertical unit is the stated one, otherwise that of
/// the band, otherwise that of the vertical axis of the CRS. The vertical datum is that of a compound or
/// three-dimensional CRS ("ellipsoid"), otherwise that in the metadata of a DTED.
/// io/geo/dem/raster_placement.h says how a raster is placed.
///
/// @param path A file, a virtual path ("/vsizip/...", "/vsicurl/..."), an address ("https://...") or
/// connection string of GDAL, or a zip archive with a single raster.
///
/// Errors: notFound, corrupt. unreadable: also a file that is shorter than its header says, any message of
/// GDAL while samples are read, a lost connection, and a file that is replaced meanwhile. unsupported: not a
/// raster, complex samples, a colour image, several subdatasets, no grid of equal steps, 2^32 - 2 samples or
/// more, more than the memory of the machine. usage: no such band; not a CRS; not a unit. invalidData: a
/// 64-bit height beyond 2^53; a geotransform without inverse. interrupted. O(samples); memory 8 bytes per
/// sample, one strip and GDAL's block cache (GDAL_CACHEMAX). Prints nothing.
Result<RasterRead> readRaster(const std::string& path, const RasterReadOptions& options = {},
                              const RunContext& context = {});

/// Reads several rasters as one (io/geo/dem/mosaic.h). Errors: also invalidData: files that are on different
/// lattices, in different CRSs or units of height.
Result<RasterRead> readRasters(const std::vector<std::string>& paths, const RasterReadOptions& options = {},
                               const RunContext& context = {});

/// Errors: unsupported: the machine has less memory. `what` begins the sentence: "100 columns by 20 rows".
Status checkMemory(double bytes, const std::string& what);

}  // namespace arete
