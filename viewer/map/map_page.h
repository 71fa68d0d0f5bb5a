// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "engine/base/result.h"
#include "terrain/model/georeference.h"
#include "viewer/picture/map_view.h"
#include "viewer/picture/picture.h"

namespace arete {

/// A page with a map: title above, caption below, scale bar and north arrow at the lower right.
struct MapPage {
  Canvas canvas;
  MapView view;  ///< of the whole grid
  Rect map;      ///< of the view on the canvas, whole pixels
  Rect side;     ///< free space beside the map; empty with sideWidth 0

  Vec2 toPage(double column, double row) const {
    const Vec2 p = view.toPixel(column, row);
    return {map.left + p.x, map.top + p.y};
  }
};

struct MapPageOptions {
  int width = 1600;   ///< of the page, pixels, at least 640
  int sideWidth = 0;  ///< kept free at the right of the map
  std::string title = {};
  std::vector<std::string> caption = {};  ///< lines
};

/// Lays out and draws the page without its map. The map is as wide as the page allows and no taller than wide
/// is; the page shrinks around a slim map. Errors: usage, when the page is narrower than 640 pixels;
/// degenerate, when the grid has one row or one column.
Result<MapPage> makeMapPage(std::uint32_t columns, std::uint32_t rows, const Georeference& georeference,
                            const MapPageOptions& options);

/// A bar of round length with its length, its right end at `right`; at most `maxWidth` pixels long.
void drawScaleBar(Canvas& canvas, Vec2 right, double maxWidth, double groundPerPixel, bool metres);

}  // namespace arete
