// SPDX-License-Identifier: GPL-3.0-or-later
//
// The ground distances of one column and one row at the centre of the grid give the aspect of the picture.
#include "viewer/picture/map_view.h"

#include <algorithm>
#include <cmath>

namespace arete {

MapView MapView::crop(const Rect& pixels, double zoom) const {
  MapView part = *this;
  const Vec2 corner = toGrid(pixels.left, pixels.top);
  part.column0 = corner.x;
  part.row0 = corner.y;
  part.width = std::max(1, int(std::lround(pixels.width * zoom)));
  part.height = std::max(1, int(std::lround(pixels.height * zoom)));
  part.columnsPerPixel /= zoom;
  part.rowsPerPixel /= zoom;
  part.groundPerPixel /= zoom;
  return part;
}

MapView fitGrid(std::uint32_t columns, std::uint32_t rows, const Georeference& georeference, int maxWidth,
                int maxHeight) {
  const double gridWidth = columns - 1.0, gridHeight = rows - 1.0;
  const Vec2 step = groundStep(georeference, gridWidth / 2, gridHeight / 2);
  const double pixelsPerGround = std::min(maxWidth / (gridWidth * step.x), maxHeight / (gridHeight * step.y));
  MapView view;
  view.width = std::clamp(int(std::lround(gridWidth * step.x * pixelsPerGround)), 1, maxWidth);
  view.height = std::clamp(int(std::lround(gridHeight * step.y * pixelsPerGround)), 1, maxHeight);
  view.columnsPerPixel = gridWidth / view.width;
  view.rowsPerPixel = gridHeight / view.height;
  view.groundPerPixel = 1 / pixelsPerGround;
  // Without a CRS a raster lies as it was written, whatever its transform says.
  if (!georeference.crsWkt.empty() && georeference.geoTransform[5] > 0) {
    view.row0 = gridHeight;
    view.rowsPerPixel = -view.rowsPerPixel;
  }
  return view;
}

}  // namespace arete
