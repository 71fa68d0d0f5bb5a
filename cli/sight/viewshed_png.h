// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "cli/arguments/terrain_error.h"
#include "cli/sight/viewshed_arguments.h"
#include "engine/base/result.h"
#include "io/geo/dem/placed_grid.h"
#include "terrain/viewshed/many.h"
#include "terrain/viewshed/viewshed.h"

namespace arete {

/// A viewshed with all that its map says about it.
struct ViewshedMapQuestion {
  const ViewshedArguments& arguments;
  const TerrainModel& model;
  const ViewshedMaker& maker;
  const ViewshedOptions& options;
  std::span<const ViewshedSite> observers;
  const PlacedGrid& grid;  ///< of cells and values
  const std::vector<ViewshedCell>& cells;
  const std::vector<double>& values;  ///< as they are written into the raster
  const TerrainError& maxError;
};

/// Draws the map of `arete viewshed --png`. Errors: of drawing and writing, and of the CRS of another grid.
Status writeViewshedPng(const ViewshedMapQuestion& question);

}  // namespace arete
