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
  double rawScale = 1;  ///< height = raw * rawScale + rawOffset, as the band declares; by default 1 and 0
  double rawOffset = 0;
  std::string source;          ///< the path or name it was read from
  std::string sourceChecksum;  ///< "xxh3-128:<hex>" of the decoded heights; see heightsChecksum()

  std::size_t size() const { return heights.size(); }
  std::uint32_t index(std::uint32_t column, std::uint32_t row) const { return row * columns + column; }
  double at(std::uint32_t column, std::uint32_t row) const {
    return heights[std::size_t(row) * columns + column];
  }
  bool isValid(std::uint32_t column, std::uint32_t row) const { return !std::isnan(at(column, row)); }

  /// Checks that heights.size() == columns * rows, that no height is infinite and that the geotransform is
  /// invertible. O(size). Errors: invalidData, culprit `source`.
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

  /// Checks that there are as many heights as positions, all of them finite. O(size). Errors: invalidData,
  /// culprit `source`.
  Status validate() const;
};

/// A checksum of the shape and the heights: the same samples have the same checksum whatever the file format
/// (NaN and zero are normalised). O(size).
/// @return "xxh3-128:<hex>"
std::string heightsChecksum(const RasterHeightfield& heightfield);
std::string heightsChecksum(const PointHeightfield& heightfield);

}  // namespace arete
