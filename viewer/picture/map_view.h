// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "engine/base/vec.h"
#include "terrain/model/georeference.h"
#include "viewer/picture/picture.h"

namespace arete {

/// The mapping between a grid and the pixels of a picture. Grid coordinates are (column, row) of samples; the
/// whole grid is [0, columns - 1] x [0, rows - 1], the domain of its triangulation, not the outer edges of
/// its pixels. The picture has the proportions of the ground: a geographic grid at 60 degrees of latitude is
/// drawn half as wide as its columns suggest. Grids with south at the top are flipped.
struct MapView {
  int width = 0, height = 0;     ///< pixels
  double column0 = 0, row0 = 0;  ///< grid position of the left top corner
  double columnsPerPixel = 1;
  double rowsPerPixel = 1;    ///< negative where rows run upwards in the picture
  double groundPerPixel = 1;  ///< metres, or source units without a CRS, at the centre

  /// Pixel position of a grid position, from the view's left top corner.
  Vec2 toPixel(double column, double row) const {
    return {(column - column0) / columnsPerPixel, (row - row0) / rowsPerPixel};
  }
  Vec2 toGrid(double x, double y) const { return {column0 + x * columnsPerPixel, row0 + y * rowsPerPixel}; }

  /// The view of the given pixels of this one only, enlarged `zoom` times.
  MapView crop(const Rect& pixels, double zoom) const;
};

/// The whole grid, as large as fits in `maxWidth` x `maxHeight` pixels. Precondition: 2 x 2 samples or more.
MapView fitGrid(std::uint32_t columns, std::uint32_t rows, const Georeference& georeference, int maxWidth,
                int maxHeight);

}  // namespace arete
