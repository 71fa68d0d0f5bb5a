// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace arete {

/// What a reader of elevation data is told, or was, beyond the name of the source: told otherwise, it may
/// read other terrain. A model remembers it (TerrainModel::reading). What is not told, the source decides.
struct SourceReading {
  std::optional<std::uint32_t> band = {};  ///< of a raster, counted from 1
  std::string layer, zField;               ///< of points; empty = not told
  std::string crs;                         ///< in any form GDAL takes; empty = not told
  std::optional<double> nodata = {};       ///< the raw value that means NODATA
};

}  // namespace arete
