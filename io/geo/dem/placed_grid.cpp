// SPDX-License-Identifier: GPL-3.0-or-later
//
// The raster is read as heights, of which only the georeference is kept.
#include "io/geo/dem/placed_grid.h"

#include <utility>

#include "io/geo/crs/longitude_turns.h"
#include "io/geo/crs/transform.h"
#include "io/geo/dem/raster_reader.h"
#include "terrain/sight/paths.h"

namespace arete {

Result<PlacedGrid> readPlacedGrid(const std::string& path, const TerrainModel& model, Warnings& warnings,
                                  const RunContext& context) {
  // Any band has the grid. Without a stated band readRaster() refuses colour images.
  RasterReadOptions options;
  options.band = 1;
  ARETE_TRY(auto raster, readRaster(path, options, context));
  warnings = std::move(raster.warnings);
  PlacedGrid grid;
  grid.columns = raster.heightfield.columns;
  grid.rows = raster.heightfield.rows;
  grid.georeference = std::move(raster.heightfield.georeference);
  const std::string &there = grid.georeference.crsWkt, &here = model.georeference.crsWkt;
  if (there.empty() != here.empty())
    return failure(ErrorCode::invalidData, "only one of it and the DEM has a CRS", path);
  grid.places.reserve(std::size_t{grid.columns} * grid.rows);
  for (std::uint32_t row = 0; row < grid.rows; ++row)
    for (std::uint32_t column = 0; column < grid.columns; ++column)
      grid.places.push_back(grid.georeference.toSource(column, row));
  if (there != here) {
    ARETE_TRY(const auto transform, CrsTransform::between(there, here));
    transform.apply(grid.places);
  }
  LongitudeTurns(model).apply(grid.places);
  bool hasPlace = false;
  for (Vec2& place : grid.places) {
    place = sightPlan(model, place);
    hasPlace = hasPlace || (place.x >= 0 && place.y >= 0 && place.x <= model.columns - 1.0 &&
                            place.y <= model.rows - 1.0);
  }
  if (!hasPlace) return failure(ErrorCode::usage, "has no sample within the DEM", path);
  return grid;
}

}  // namespace arete
