// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

#include "engine/base/vec.h"
#include "terrain/model/georeference.h"
#include "viewer/picture/picture.h"

namespace arete {

/// The mapping between a grid and the pixels of a picture. Grid coordinates are (column, row) of samples; the
/// whole grid is [0, columns - 1] x [0, rows - 1], the domain of its triangulation, not the outer edges of
/// its pixels. The aspect is the ground's: a geographic grid at 60 degrees is drawn half as wide as its
/// columns say. South-up grids are turned over.
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

  /// The part of this view in the given pixels, enlarged `zoom` times.
  MapView crop(const Rect& pixels, double zoom) const;
};

/// The whole grid, as large as fits `maxWidth` x `maxHeight` pixels. Precondition: at least 2 x 2 samples.
MapView fitGrid(std::uint32_t columns, std::uint32_t rows, const Georeference& georeference, int maxWidth,
                int maxHeight);

/// Direction of grid north in the picture, y downwards, of length 1; none where no CRS says what north is.
std::optional<Vec2> northInView(const MapView& view, const Georeference& georeference);

}  // namespace arete
