// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/finest_raster.h"

namespace arete {

std::vector<std::array<std::uint32_t, 3>> finestTriangulation(const RasterHeightfield& heightfield) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  if (heightfield.columns < 2 || heightfield.rows < 2) return triangles;
  triangles.reserve(std::size_t(heightfield.columns - 1) * (heightfield.rows - 1) * 2);
  for (std::uint32_t row = 0; row + 1 < heightfield.rows; ++row)
    for (std::uint32_t column = 0; column + 1 < heightfield.columns; ++column) {
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
    }
  return triangles;
}

}  // namespace arete
