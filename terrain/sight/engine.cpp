// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/sight/engine.h"

#include <string>
#include <utility>

#include "engine/base/caught_failure.h"

namespace arete {
namespace {

/// From this many lines on, reading all samples of a raster pays off.
constexpr std::size_t kManyLines = 1000;

}  // namespace

SightMethod methodFor(std::size_t lines, double maxError, const TerrainModel& model) {
  return maxError > 0 || !model.isRaster || lines < kManyLines ? SightMethod::descent : SightMethod::pyramid;
}

std::string_view toString(SightMethod method) {
  switch (method) {
    case SightMethod::descent:
      return "descent";
    case SightMethod::pyramid:
      return "pyramid";
    case SightMethod::scan:
      return "scan";
    case SightMethod::embree:
      return "embree";
    default:
      return "automatic";
  }
}

Result<std::unique_ptr<SightEngine>> makeSightEngine(SightMethod method, const TerrainModel& model,
                                                     std::shared_ptr<const SightGrid> grid,
                                                     const RunContext& context) try {
  if (method == SightMethod::automatic) method = model.isRaster ? SightMethod::pyramid : SightMethod::descent;
  if (method == SightMethod::descent) return makeSightDescent(model);
  if (!model.isRaster)
    return failure(ErrorCode::unsupported, "walks over the cells of a raster; this model is of points",
                   "the method " + std::string(toString(method)));
  if (method == SightMethod::embree) return makeSightEmbree(model);
  if (!grid) grid = std::make_shared<SightGrid>(model);
  return method == SightMethod::scan ? makeSightScan(std::move(grid))
                                     : makeSightPyramid(std::move(grid), context);
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
