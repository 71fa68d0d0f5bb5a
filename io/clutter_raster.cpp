// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/clutter_raster.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>
#include <utility>

#include "io/crs_transform.h"
#include "io/raster_reader.h"

namespace arete {

Result<SightClutter> readClutter(const std::string& text, const TerrainModel& model,
                                 const RunContext& context) {
  SightClutter clutter;
  double height = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), height);
  if (error == std::errc{} && end == text.data() + text.size()) {
    if (!(height >= 0) || !std::isfinite(height))
      return failure(ErrorCode::usage, "is no height of what stands on the terrain", "--clutter " + text);
    clutter.height = [height](Vec2) { return height; };
    return clutter;
  }
  auto read = readRaster(text, {}, context);
  if (!read) return tl::unexpected(read.error());
  const Georeference& own = read->heightfield.georeference;
  const Georeference& dem = model.georeference;
  if (own.crsWkt.empty() != dem.crsWkt.empty() || (!own.crsWkt.empty() && own.crsWkt != dem.crsWkt && [&] {
        const auto way = CrsTransform::between(own.crsWkt, dem.crsWkt);
        return !way || !way->isIdentity();
      }()))
    return failure(ErrorCode::usage, "is in another CRS than the DEM; gdalwarp brings it there", text);
  const Vec2 step = groundStep(own, read->heightfield.columns / 2.0, read->heightfield.rows / 2.0);
  clutter.stepMetres = std::min(step.x, step.y) / 2;
  const double scale = own.verticalUnit.empty() || dem.verticalUnit.empty()
                           ? 1
                           : own.verticalUnitMetres / dem.verticalUnitMetres;
  const auto samples = std::make_shared<const RasterHeightfield>(std::move(read->heightfield));
  const auto place = std::make_shared<const Georeference>(dem);
  const bool isRaster = model.isRaster;
  clutter.height = [samples, place, isRaster, scale](Vec2 plan) {
    const Vec2 xy = isRaster ? place->toSource(plan.x, plan.y) : plan;
    const Vec2 at = samples->georeference.toGrid(xy.x, xy.y);
    const double column = std::floor(at.x + 0.5), row = std::floor(at.y + 0.5);
    if (!(column >= 0 && row >= 0 && column < samples->columns && row < samples->rows)) return 0.0;
    const double z = samples->at(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row));
    return std::isnan(z) ? 0.0 : std::max(0.0, z * scale);
  };
  return clutter;
}

}  // namespace arete
