// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"

namespace arete {

/// A corner of cells: the first cell of a raster has the corners (0, 0) and (1, 1).
struct CellCorner {
  std::uint32_t column = 0, row = 0;
  bool operator==(const CellCorner&) const = default;
};

/// Neighbouring cells of one value in a row.
struct CellRun {
  std::uint32_t row = 0, begin = 0, end = 0;  ///< columns from `begin` to before `end`
};

/// Cells of one value that are connected through their edges, as a polygon.
struct CellPolygon {
  double value = 0;
  std::uint64_t cells = 0;
  double area = 0;  ///< the sum of what `areaOf` says of its runs
  /// The outer ring first, then the holes. Each names its corners once, without those on a straight line;
  /// with rows counted downwards the outer ring turns counterclockwise and holes clockwise.
  std::vector<std::vector<CellCorner>> rings;
};

/// A raster of values, row by row; NaN stands for cells without a value, which belong to no polygon.
struct CellValues {
  std::uint32_t columns = 0, rows = 0;
  std::span<const double> values;
  std::size_t stride = 0;  ///< values from row to row, at least `columns`

  double at(std::uint32_t column, std::uint32_t row) const { return values[row * stride + column]; }
};

/// Divides the cells of a raster into polygons, each of which is handed over as soon as the last of its rows
/// is reached. Every cell with a value is in exactly one polygon. Polygons are valid as OGC defines it: no
/// ring meets itself, and rings of a polygon meet each other in single points at most. Cells that meet in a
/// corner only are two polygons, since no valid polygon has both.
///
/// @param areaOf the area of a run of cells
/// @param take its error ends the work
/// @param stage under which progress is reported
///
/// Errors: what `take` returns; interrupted. O(cells + corners log corners); memory: 8 bytes for each run of
/// equal values in a row, a bit for each cell, and the rings of polygons that are not complete.
Status forCellPolygons(const CellValues& raster, const std::function<double(const CellRun&)>& areaOf,
                       const std::function<Status(CellPolygon)>& take, std::string_view stage,
                       const RunContext& context);

}  // namespace arete
