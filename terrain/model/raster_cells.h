// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

#include "terrain/model/heightfield.h"

namespace arete {

/// The cells of a raster, each given by the column and row of its upper left sample: which of its corners are
/// valid, and its triangles in the finest triangulation (finest_raster.h). Keeps a reference to the
/// heightfield. Precondition of every member: column < columns - 1, row < rows - 1.
class RasterCells {
 public:
  using Corners = std::array<std::uint32_t, 3>;
  enum Corner : unsigned { upperLeft = 1, upperRight = 2, lowerLeft = 4, lowerRight = 8, all = 15 };

  explicit RasterCells(const RasterHeightfield& field) : field_(field) {}

  /// The valid corners of a cell, a sum of Corner values.
  unsigned valid(std::uint32_t column, std::uint32_t row) const {
    const double* above = &field_.heights[field_.index(column, row)];
    const double* under = above + field_.columns;
    return unsigned(above[0] == above[0]) * upperLeft | unsigned(above[1] == above[1]) * upperRight |
           unsigned(under[0] == under[0]) * lowerLeft | unsigned(under[1] == under[1]) * lowerRight;
  }

  /// The number of triangles of a cell: 2 with four valid corners, 1 with three, else 0.
  static std::uint32_t triangleCount(unsigned valid) {
    return valid == all ? 2 : valid == 7 || valid == 11 || valid == 13 || valid == 14 ? 1 : 0;
  }

  /// Calls visit(corners) for each triangle of a cell: samples, counter-clockwise in (column, row).
  /// @param valid  valid(column, row)
  template <class Visit>
  void forTriangles(std::uint32_t column, std::uint32_t row, unsigned valid, const Visit& visit) const {
    const std::uint32_t ul = field_.index(column, row), ur = ul + 1, ll = ul + field_.columns, lr = ll + 1;
    const auto has = [&](unsigned corners) { return (valid & corners) == corners; };
    if (has(upperLeft | lowerRight)) {
      if (has(upperRight)) visit(Corners{ul, ur, lr});
      if (has(lowerLeft)) visit(Corners{ul, lr, ll});
    } else if (has(upperRight | lowerLeft)) {
      if (has(upperLeft)) visit(Corners{ul, ur, ll});
      if (has(lowerRight)) visit(Corners{ur, lr, ll});
    }
  }

 protected:
  const RasterHeightfield& field_;
};

}  // namespace arete
