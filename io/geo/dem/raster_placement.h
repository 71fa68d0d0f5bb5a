// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/warning.h"
#include "terrain/model/georeference.h"

namespace arete {

/// Places a raster by its geotransform, or by ground control points that lie on a grid of equal steps (within
/// 0.01 pixel). One without any position gets columns as x and rows as y, counted upwards from the last one,
/// so that the first row is the northern one; a warning says so.
///
/// @return The CRS of that position; empty where there is none.
///
/// Errors: unsupported: ground control points on no grid of equal steps, RPCs, or arrays of geolocation (a
/// curvilinear grid); the message says how to resample.
Result<OGRSpatialReference> placeRaster(GDALDataset& dataset, Georeference& georeference, Warnings& warnings);

}  // namespace arete
