// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "cli/sight/viewshed_arguments.h"
#include "io/geo/dem/raster_writer.h"
#include "io/geo/polygons/polygon_file.h"
#include "terrain/viewshed/many.h"
#include "terrain/viewshed/viewshed.h"

namespace arete {

/// What `arete viewshed` writes of an answer.
struct ViewshedPicture {
  std::vector<double> values;
  GeoTiffOptions options;
  bool isHeight = false;  ///< values are heights, in the unit of the DEM
};

ViewshedPicture viewshedPictureOfOne(ViewshedMode mode, const Viewshed& viewshed);
ViewshedPicture viewshedPictureOfMany(ViewshedMode mode, const ViewshedOfMany& all);

/// What the polygons of an answer say. Precondition: not height or horizon, whose values are no classes.
PolygonFields viewshedPolygonFields(ViewshedMode mode, std::string layer);

}  // namespace arete
