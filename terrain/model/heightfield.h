// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "terrain/model/georeference.h"

namespace arete {

/// Heights on a grid, row-major from the first row of the raster. NaN = no data.
/// Heights are in the DEM's vertical unit, scale and offset applied.
struct RasterHeightfield {
  std::uint32_t columns = 0;
  std::uint32_t rows = 0;
  std::vector<double> heights;

  Georeference georeference;
  double rawScale = 1;  ///< height = raw * rawScale + rawOffset, as the band declares; 1, 0 where it does not
  double rawOffset = 0;
  std::string source;          ///< the path or name it was read from
  std::string sourceChecksum;  ///< "xxh3-128:<hex>" of the decoded heights; see heightsChecksum()

  std::size_t size() const { return heights.size(); }
  std::uint32_t index(std::uint32_t column, std::uint32_t row) const { return row * columns + column; }
  double at(std::uint32_t column, std::uint32_t row) const {
    return heights[std::size_t(row) * columns + column];
  }
  bool isValid(std::uint32_t column, std::uint32_t row) const { return !std::isnan(at(column, row)); }

  /// heights.size() == columns * rows, no infinite height, an invertible geotransform. O(size).
  Status validate() const;
};

/// Scattered points: one height per plan position.
struct PointHeightfield {
  std::vector<Vec2> positions;  ///< source coordinates
  std::vector<double> heights;

  Georeference georeference;
  std::string source;
  std::string sourceChecksum;

  std::size_t size() const { return heights.size(); }

  /// As many heights as positions, all finite. O(size).
  Status validate() const;
};

/// "xxh3-128:<hex>" over size, grid shape and the bytes of the heights (NaN made canonical): the same samples
/// give the same checksum whatever file they came in. O(size).
std::string heightsChecksum(const RasterHeightfield& heightfield);
std::string heightsChecksum(const PointHeightfield& heightfield);

}  // namespace arete
