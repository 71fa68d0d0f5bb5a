// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "engine/base/result.h"
#include "terrain/model/georeference.h"
#include "viewer/decoration/legend.h"
#include "viewer/decoration/picture_ground.h"
#include "viewer/picture/map_view.h"
#include "viewer/picture/picture.h"

namespace arete {

/// A page with a map: title above, caption below, scale bar and north arrow at the lower right, legends
/// beside.
struct MapPage {
  Canvas canvas;
  MapView view;  ///< of the whole grid
  Rect map;      ///< of the view on the canvas, whole pixels
  Rect side;     ///< free space beside the map; empty with sideWidth 0
  PictureGround ground;
  bool isDecorated = true;
  std::vector<DrawnScale> scales = {};  ///< of the legends

  /// Draws what lies over the map, once it is drawn: the graticule and the frame.
  void finish();

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
  std::vector<ColorLegend> legends = {};  ///< drawn at the right of the map, in room of their own
  bool isDecorated = true;                ///< false: no legend, scale bar, north arrow or graticule
};

/// Lays out and draws the page without its map. The map is as wide as the page allows and no taller than wide
/// is; the page shrinks around a slim map. Legends are drawn too. Errors: usage, when the page is narrower
/// than 640 pixels; degenerate, when the grid has one row or one column.
Result<MapPage> makeMapPage(std::uint32_t columns, std::uint32_t rows, const Georeference& georeference,
                            const MapPageOptions& options);

}  // namespace arete
