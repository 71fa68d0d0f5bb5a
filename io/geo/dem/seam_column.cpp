// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/dem/seam_column.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "io/geo/crs/longitude_turns.h"

namespace arete {

bool repeatFirstColumn(RasterHeightfield& raster) {
  constexpr double kOff = 0.05;  // columns: a step of six digits is rounded by as much over the Earth
  Georeference& g = raster.georeference;
  const double step = std::abs(g.geoTransform[1]);
  if (!g.isGeographic || !g.hasGeoTransform || g.repeatsFirstColumn || g.geoTransform[2] != 0 ||
      g.geoTransform[4] != 0 || !(std::abs(raster.columns - turnOf(g) / step) <= kOff) ||
      raster.columns < 3 || raster.columns == std::numeric_limits<std::uint32_t>::max())
    return false;
  const std::size_t columns = raster.columns, rows = raster.rows;
  std::vector<double>& heights = raster.heights;
  heights.resize(heights.size() + rows);
  for (std::size_t row = rows; row-- > 0;) {
    const auto from = heights.begin() + std::ptrdiff_t(row * columns), end = from + std::ptrdiff_t(columns);
    const auto behind = heights.begin() + std::ptrdiff_t((row + 1) * (columns + 1) - 1);
    const double first = *from;
    if (row > 0) std::move_backward(from, end, behind);
    *behind = first;
  }
  ++raster.columns;
  g.repeatsFirstColumn = true;
  raster.sourceChecksum = heightsChecksum(raster);
  return true;
}

}  // namespace arete
