// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "terrain/model/terrain_model.h"

namespace arete {

/// The finest triangulation of a raster as its samples: what engines that walk over cells read.
/// Plan coordinates are (column, row). A cell with four valid corners is split from its upper-left to its
/// lower-right sample, one with three is one triangle.
class SightGrid {
 public:
  /// Precondition: a raster model. O(samples); 8 bytes each.
  explicit SightGrid(const TerrainModel& model);
  SightGrid(std::uint32_t columns, std::uint32_t rows, std::vector<double> heights);

  std::uint32_t columns() const { return columns_; }
  std::uint32_t rows() const { return rows_; }
  /// NaN where there is none.
  double height(std::uint32_t column, std::uint32_t row) const {
    return heights_[std::size_t{row} * columns_ + column];
  }
  const double* row(std::uint32_t row) const { return heights_.data() + std::size_t{row} * columns_; }

  /// The height of the surface; NaN where there is none. A place on a border belongs to it. O(1).
  double at(Vec2 plan) const;

 private:
  std::uint32_t columns_, rows_;
  std::vector<double> heights_;
};

/// The surface of one cell, in coordinates from its upper-left sample.
struct SightCell {
  double ul, ur, ll, lr;

  bool isWhole() const { return !std::isnan(ul + ur + ll + lr); }
  /// Precondition: isWhole(), or three corners and the place on their triangle.
  double at(double x, double y) const {
    if (std::isnan(ul)) return lr + (1 - x) * (ll - lr) + (1 - y) * (ur - lr);
    if (std::isnan(lr)) return ul + x * (ur - ul) + y * (ll - ul);
    return std::isnan(ll) || (x >= y && !std::isnan(ur)) ? ul + x * (ur - ul) + y * (lr - ur)
                                                         : ul + y * (ll - ul) + x * (lr - ll);
  }
  /// Of a cell with three corners: positive inside of their triangle, linear in x and y.
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
