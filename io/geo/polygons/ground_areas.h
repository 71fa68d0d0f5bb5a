// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/base/result.h"
#include "terrain/model/georeference.h"

namespace arete {

/// The areas that cells of a raster cover on the ellipsoid of its CRS, in square metres. They count the
/// ground as level: slopes and heights above the ellipsoid are left out, as maps have it.
///
/// A cell is measured by the vectors between the middles of its edges, on the ellipsoid; between the cells of
/// a grid of 256 x 256 at most the areas are interpolated. Wrong by less than a thousandth where cells are
/// smaller than a hundredth of the Earth's radius and the map's scale changes by less than a tenth from grid
/// line to grid line.
class GroundAreas {
 public:
  /// Nothing where the raster has no CRS or position, or no longitude and latitude: then nothing is known of
  /// areas. O(grid).
  static std::optional<GroundAreas> of(const Georeference& georeference, std::uint32_t columns,
                                       std::uint32_t rows);

  /// The area of the cells of a row from column `begin` to before `end`. NaN where one of them has no place
  /// on the ellipsoid. O(columns) for the first run of a row, O(1) for the next ones of it; rows in any
  /// order.
  double ofRun(std::uint32_t row, std::uint32_t begin, std::uint32_t end);

 private:
  GroundAreas() = default;
  void sumRow(std::uint32_t row);

  std::uint32_t columns_ = 0, row_ = 0;
  std::vector<std::uint32_t> atColumns_,
      atRows_;                       // of the grid, the first and the last of the raster among them
  std::vector<double> areas_;        // of the grid's cells
  std::vector<double> sums_;         // of the cells of row_ before each column; empty: no row yet
  std::vector<std::uint32_t> lost_;  // cells of row_ without a place, before each column
};

}  // namespace arete
