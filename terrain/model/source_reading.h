// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace arete {

/// The options of a reader of elevation data that change which terrain is read, beside the name of the
/// source. Options left empty are determined by the source. A model stores them (TerrainModel::reading).
struct SourceReading {
  std::optional<std::uint32_t> band = {};  ///< of a raster, counted from 1
  std::string layer, zField;               ///< of points; empty = not given
  std::string samePlace = {};         ///< of points: min, max, mean, first; empty = different heights are
                                      ///< an error
  std::string crs = {};               ///< in any form that GDAL accepts; empty = not given
  std::optional<double> nodata = {};  ///< the raw value that means NODATA; NaN: no other value does
  std::string verticalUnit = {};      ///< of the heights, instead of the source's; empty = not given
  std::optional<bool> isDepth = {};   ///< whether the values count downwards and are to be negated
  /// What was named after the first source: more rasters of a mosaic, or folders or patterns of them.
  std::vector<std::string> otherFiles = {};
};

}  // namespace arete
