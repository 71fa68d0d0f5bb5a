// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "terrain/model/georeference.h"

namespace arete {

/// Whether a name is a GeoTIFF's: it ends in .tif or .tiff, upper or lower case.
bool isGeoTiffName(const std::string& path);

struct GeoTiffOptions {
  enum class Sample { float32, float64, uint8, uint16 };
  enum class Compression {
    none,
    deflate,
    zstd,  ///< deflate where GDAL was built without it
  };
  Sample sample = Sample::float32;
  Compression compression = Compression::deflate;
  std::string description = {};  ///< of the band; empty = none
  double nodata = 0;             ///< of whole numbers: what stands for NaN; floats keep NaN
};

/// Writes one band of row-major values as a tiled GeoTIFF: NaN is declared as NODATA, the vertical unit
/// becomes the band's, CRS and geotransform come from the georeference (no geotransform is written where it
/// has none). The file appears under its name whole or not at all, and takes the place of an older one
/// together with its GDAL sidecar files (.aux.xml, .ovr, .msk).
///
/// Precondition: values.size() == columns * rows, columns and rows positive; otherwise invalidData.
/// Errors: invalidData (also a value that the samples cannot hold), notFound (no such folder), unreadable
/// (cannot be written), interrupted.
///
/// O(values); memory: one row of tiles and GDAL's block cache.
Status writeGeoTiff(const std::string& path, std::uint32_t columns, std::uint32_t rows,
                    std::span<const double> values, const Georeference& georeference,
                    const GeoTiffOptions& options = {}, const RunContext& context = {});

}  // namespace arete
