// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#include "terrain/sight/grid.h"
#include "terrain/viewshed/image_plane.h"

namespace arete {

/// The samples of a raster in the axes of a sector (ViewshedSector), and which edges and triangles they have.
/// An edge belongs to the terrain if both its samples are there, and a sample of a triangle beside it.
class SectorGrid {
 public:
  /// Precondition: the grid outlives it.
  SectorGrid(const SightGrid& grid, const ViewshedSector& sector)
      : grid_(grid),
        sector_(sector),
        xGreatest_(sector.sign > 0 ? sizeAlong(sector.isAlongRows) - 1 : 0),
        xLeast_(xGreatest_ - sizeAlong(sector.isAlongRows) + 1),
        yGreatest_(sector.sign > 0 ? sizeAlong(!sector.isAlongRows) - 1 : 0),
        yLeast_(yGreatest_ - sizeAlong(!sector.isAlongRows) + 1) {}

  int xLeast() const { return xLeast_; }
  int xGreatest() const { return xGreatest_; }
  int yLeast() const { return yLeast_; }
  int yGreatest() const { return yGreatest_; }

  /// @return index of a sample in the raster, row by row. Precondition: it is in the raster.
  std::size_t index(int x, int y) const {
    const auto column = static_cast<std::size_t>(sector_.line(sector_.isAlongRows ? x : y)),
               row = static_cast<std::size_t>(sector_.line(sector_.isAlongRows ? y : x));
    return row * grid_.columns() + column;
  }
  /// @return NaN for NODATA and outside of the raster.
  double height(int x, int y) const {
    return y < yLeast_ || y > yGreatest_ || x < xLeast_ || x > xGreatest_
               ? std::numeric_limits<double>::quiet_NaN()
               : grid_.row(0)[index(x, y)];
  }
  bool isThere(int x, int y) const { return !std::isnan(height(x, y)); }

  /// @return how many triangles, 0 to 2, the edge from (x - 1, y) to (x, y) has if both its samples are
  /// there.
  int trianglesAlong(int x, int y) const {
    return int{isThere(x, y - 1) || isThere(x - 1, y - 1)} + int{isThere(x, y + 1) || isThere(x - 1, y + 1)};
  }
  /// @return the same for the edge from (x, y) to (x, y + 1).
  int trianglesAcross(int x, int y) const {
    return int{isThere(x - 1, y) || isThere(x - 1, y + 1)} + int{isThere(x + 1, y) || isThere(x + 1, y + 1)};
  }

  /// @return whether a line in the direction u over the sample may be over no terrain both before and behind
  ///     it: the sample is then a tip of the terrain, which the line meets in a single point.
  bool isTip(int x, int y, double u) const {
    const auto hasTerrain = [&](int ahead, int side) {
      return isThere(x + ahead, y) && (isThere(x + ahead, y + side) || isThere(x, y + side));
    };
    const auto isBetween = [&](int side) { return !hasTerrain(1, side) && !hasTerrain(-1, -side); };
    // Directions this near to a lattice line or a diagonal may be on either side of it.
    constexpr double kAlong = 1e-6;
    if (std::fabs(u) < kAlong) return isBetween(1) || isBetween(-1);
    if (std::fabs(u) > 1 - kAlong)
      return !isThere(x + 1, y) || !isThere(x - 1, y) || !isThere(x, y - 1) || !isThere(x, y + 1);
    return isBetween(u > 0 ? 1 : -1);
  }

 private:
  int sizeAlong(bool isAlongRows) const {
    return static_cast<int>(isAlongRows ? grid_.columns() : grid_.rows());
  }

  const SightGrid& grid_;
  ViewshedSector sector_;
  int xGreatest_, xLeast_, yGreatest_, yLeast_;
};

}  // namespace arete
