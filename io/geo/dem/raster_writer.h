// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "terrain/model/georeference.h"

namespace arete {

/// @return True for a name that ends in .tif or .tiff, in either case.
bool isGeoTiffName(const std::string& path);

struct GeoTiffOptions {
  enum class Sample { float32, float64, uint8, uint16 };
  enum class Compression {
    none,
    deflate,
    zstd,  ///< deflate if GDAL was built without it
  };
  /// The colour in which programs show a value.
  struct Color {
    std::uint8_t value, red, green, blue;
  };
  Sample sample = Sample::float32;
  Compression compression = Compression::deflate;
  std::string description = {};  ///< of the band
  double nodata = 0;             ///< the value of NaN for integer samples; floats keep NaN
  /// Of 8-bit samples alone: the colour table, which lies in the file itself and changes no value. Programs
  /// show NODATA as transparent and values without a colour in black. Empty: no table.
  std::vector<Color> colors = {};
};

/// Writes one band of values as a tiled GeoTIFF. NaN is declared as NODATA. The vertical unit becomes that of
/// the band; CRS and geotransform come from the georeference, if it has them. The file appears complete or
/// not at all. It replaces an older one together with its GDAL sidecar files (.aux.xml, .ovr, .msk).
///
/// @param values Row by row. The last column is left out where the georeference says that it repeats the
/// first.
///
/// Errors: invalidData: values.size() != columns * rows, or either is 0; a value that the sample type cannot
/// hold. notFound: no such folder. unreadable: the file cannot be written. interrupted. O(values); memory:
/// one row of tiles and GDAL's block cache.
Status writeGeoTiff(const std::string& path, std::uint32_t columns, std::uint32_t rows,
                    std::span<const double> values, const Georeference& georeference,
                    const GeoTiffOptions& options = {}, const RunContext& context = {});

}  // namespace arete
