// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/finest_raster.h"

#include <algorithm>

namespace arete {

std::vector<std::array<std::uint32_t, 3>> finestTriangulation(const RasterHeightfield& heightfield) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  if (heightfield.columns < 2 || heightfield.rows < 2) return triangles;
  triangles.reserve(std::size_t(heightfield.columns - 1) * (heightfield.rows - 1) * 2);
  const auto addCell = [&](std::uint32_t column, std::uint32_t row) {
    const std::uint32_t upperLeft = heightfield.index(column, row), upperRight = upperLeft + 1,
                        lowerLeft = upperLeft + heightfield.columns, lowerRight = lowerLeft + 1;
    const bool ul = !std::isnan(heightfield.heights[upperLeft]),
               ur = !std::isnan(heightfield.heights[upperRight]),
               ll = !std::isnan(heightfield.heights[lowerLeft]),
               lr = !std::isnan(heightfield.heights[lowerRight]);
    if (ul && lr) {
      if (ur) triangles.push_back({upperLeft, upperRight, lowerRight});
      if (ll) triangles.push_back({upperLeft, lowerRight, lowerLeft});
    } else if (ur && ll) {
      if (ul) triangles.push_back({upperLeft, upperRight, lowerLeft});
      if (lr) triangles.push_back({upperRight, lowerRight, lowerLeft});
    }
  };
  // Tile by tile, so that triangles near each other on the ground are near each other in memory.
  constexpr std::uint32_t kTile = 32;
  for (std::uint32_t top = 0; top + 1 < heightfield.rows; top += kTile)
    for (std::uint32_t left = 0; left + 1 < heightfield.columns; left += kTile)
      for (std::uint32_t row = top; row < std::min(top + kTile, heightfield.rows - 1); ++row)
        for (std::uint32_t column = left; column < std::min(left + kTile, heightfield.columns - 1); ++column)
          addCell(column, row);
  return triangles;
}

}  // namespace arete
