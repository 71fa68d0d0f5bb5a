// SPDX-License-Identifier: GPL-3.0-or-later
//
// A text that is a number as a whole is a uniform height; any other is a path. Pixels are areas: no
// interpolation.
#include "io/geo/dem/clutter_raster.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <utility>

#include "engine/base/caught_failure.h"
#include "io/files/text/length_unit.h"
#include "io/geo/crs/data_unit.h"
#include "io/geo/crs/longitude_turns.h"
#include "io/geo/crs/map_scale.h"
#include "io/geo/crs/transform.h"
#include "io/geo/dem/raster_reader.h"
#include "terrain/model/plan_box.h"

namespace arete {
namespace {

struct PlanExtent {
  double xMin = std::numeric_limits<double>::infinity(), yMin = xMin, xMax = -xMin, yMax = -xMin;

  void add(Vec2 p) {
    xMin = std::min(xMin, p.x);
    yMin = std::min(yMin, p.y);
    xMax = std::max(xMax, p.x);
    yMax = std::max(yMax, p.y);
  }
};

PlanExtent planExtentOf(const TerrainModel& model) {
  PlanExtent extent;
  const Box2 box = planBox(model);
  for (const double x : {box.xMin, box.xMax})
    for (const double y : {box.yMin, box.yMax}) extent.add(model.toSource({x, y}));
  return extent;
}

/// With the whole areas of the pixels, half a step around their centres.
PlanExtent planExtentOf(const RasterHeightfield& raster) {
  PlanExtent extent;
  for (const double column : {-0.5, raster.columns - 0.5})
    for (const double row : {-0.5, raster.rows - 0.5}) extent.add(raster.georeference.toSource(column, row));
  return extent;
}

/// Tests bounding boxes only; that of a rotated raster is larger than the raster.
bool mayOverlap(const TerrainModel& model, const RasterHeightfield& raster) {
  const PlanExtent dem = planExtentOf(model), own = planExtentOf(raster);
  if (!(own.yMin <= dem.yMax && dem.yMin <= own.yMax)) return false;
  // The two may lie a turn apart, and either may be the wider.
  const double middle = dem.xMin / 2 + dem.xMax / 2;
  const double turned =
      LongitudeTurns(raster.georeference, raster.columns, raster.rows)({middle, own.yMin}).x;
  return own.xMin <= turned + (dem.xMax - middle) && turned - (middle - dem.xMin) <= own.xMax;
}

}  // namespace

Result<SightClutter> readClutter(const std::string& text, const TerrainModel& model,
                                 const RunContext& context) try {
  SightClutter clutter;
  if (const auto length = parseLength(text, "clutter");
      length && !(length->hasUnit() && std::filesystem::exists(text))) {
    ARETE_TRY(const double height, inDataUnit(*length, heightUnitOf(model.georeference), "clutter " + text));
    if (!(height >= 0) || !std::isfinite(height))
      return failure(ErrorCode::usage, "must be a height of at least 0", "clutter " + text);
    clutter.height = [height](Vec2) { return height; };
    return clutter;
  }
  ARETE_TRY(auto read, readRaster(text, {}, context));
  stateMapScale(
      read.heightfield.georeference,
      read.heightfield.georeference.toSource(read.heightfield.columns / 2.0, read.heightfield.rows / 2.0));
  const Georeference& own = read.heightfield.georeference;
  const Georeference& dem = model.georeference;
  if (own.crsWkt.empty() != dem.crsWkt.empty() || (!own.crsWkt.empty() && own.crsWkt != dem.crsWkt && [&] {
        const auto way = CrsTransform::between(own.crsWkt, dem.crsWkt);
        return !way || !way->isIdentity();
      }()))
    return failure(ErrorCode::usage, "is in another CRS than the DEM; gdalwarp can transform it", text);
  if (!mayOverlap(model, read.heightfield))
    return failure(ErrorCode::usage, "lies nowhere over the DEM", text);
  const Vec2 step = groundStep(own, read.heightfield.columns / 2.0, read.heightfield.rows / 2.0);
  clutter.stepMetres = std::min(step.x, step.y) / 2;
  const double scale = own.verticalUnit.empty() || dem.verticalUnit.empty()
                           ? 1
                           : own.verticalUnitMetres / dem.verticalUnitMetres;
  const auto samples = std::make_shared<const RasterHeightfield>(std::move(read.heightfield));
  const auto georeference = std::make_shared<const Georeference>(dem);
  const bool isRaster = model.isRaster;
  const LongitudeTurns turns(samples->georeference, samples->columns, samples->rows);
  clutter.height = [samples, georeference, isRaster, scale, turns](Vec2 plan) {
    const Vec2 xy = turns(isRaster ? georeference->toSource(plan.x, plan.y) : plan);
    const Vec2 at = samples->georeference.toGrid(xy.x, xy.y);
    const double column = std::floor(at.x + 0.5), row = std::floor(at.y + 0.5);
    if (!(column >= 0 && row >= 0 && column < samples->columns && row < samples->rows)) return 0.0;
    const double z = samples->at(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row));
    return std::isnan(z) ? 0.0 : std::max(0.0, z * scale);
  };
  return clutter;
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
