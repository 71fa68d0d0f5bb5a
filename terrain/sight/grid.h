// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "terrain/model/terrain_model.h"

namespace arete {

/// The samples of a raster, which stand for its finest triangulation. Plan coordinates are (column, row). A
/// cell with four valid corners is split from its upper left to its lower right sample; a cell with three is
/// one triangle; a cell with fewer has no terrain.
class SightGrid {
 public:
  /// Precondition: a raster model. O(samples); 8 bytes each.
  explicit SightGrid(const TerrainModel& model);
  /// @param heights row by row; NaN = NODATA. Precondition: columns * rows of them.
  SightGrid(std::uint32_t columns, std::uint32_t rows, std::vector<double> heights);

  std::uint32_t columns() const { return columns_; }
  std::uint32_t rows() const { return rows_; }
  /// @return NaN for NODATA. Precondition: inside the raster.
  double height(std::uint32_t column, std::uint32_t row) const {
    return heights_[std::size_t{row} * columns_ + column];
  }
  const double* row(std::uint32_t row) const { return heights_.data() + std::size_t{row} * columns_; }

  /// @return the height of the surface; NaN where there is none. The border of a triangle belongs to it.
  /// O(1).
  double at(Vec2 plan) const;

 private:
  std::uint32_t columns_, rows_;
  std::vector<double> heights_;
};

/// The surface of one cell, by its corners; coordinates x, y from 0 to 1 are from its upper left sample.
struct SightCell {
  double ul, ur, ll, lr;  ///< upper left, upper right, lower left, lower right; NaN = NODATA

  bool isWhole() const { return !std::isnan(ul + ur + ll + lr); }
  /// Precondition: isWhole(), or three corners and the place on their triangle.
  double at(double x, double y) const {
    if (std::isnan(ul)) return lr + (1 - x) * (ll - lr) + (1 - y) * (ur - lr);
    if (std::isnan(lr)) return ul + x * (ur - ul) + y * (ll - ul);
    return std::isnan(ll) || (x >= y && !std::isnan(ur)) ? ul + x * (ur - ul) + y * (lr - ur)
                                                         : ul + y * (ll - ul) + x * (lr - ll);
  }
  /// Of a cell with three corners: positive inside of their triangle, 0 on its diagonal, linear in x and y.
  double inside(double x, double y) const {
    if (std::isnan(ul)) return x + y - 1;
    if (std::isnan(lr)) return 1 - x - y;
    return std::isnan(ll) ? x - y : y - x;
  }
  int corners() const {
    return int{!std::isnan(ul)} + int{!std::isnan(ur)} + int{!std::isnan(ll)} + int{!std::isnan(lr)};
  }
};

}  // namespace arete
