// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/model/cell_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "terrain/model/plan_box.h"

namespace arete {
namespace {

Result<int> sizeOf(double extent, double cell) {
  const double size = std::max(1.0, std::ceil(extent / cell - 1e-6));
  if (!(size <= std::numeric_limits<int>::max()))
    return failure(ErrorCode::usage, fmt::format("{} pixels in a row are more than GDAL can number", size),
                   fmt::format("cell={}", cell));
  return static_cast<int>(size);
}

}  // namespace

Result<CellGrid> cellGridOf(const TerrainModel& model, double cell) {
  if (!(cell > 0) || !std::isfinite(cell))
    return failure(ErrorCode::usage, "is not above 0", fmt::format("cell={}", cell));
  const Box2 plan = planBox(model);
  const double rim = model.isRaster ? 0.5 : 0;
  const double repeated = model.georeference.repeatsFirstColumn ? 1 : 0;
  std::vector<Vec2> corners;
  for (const double x : {plan.xMin - rim, plan.xMax - repeated + rim})
    for (const double y : {plan.yMin - rim, plan.yMax + rim}) corners.push_back(model.toSource({x, y}));
  const Box2 box = planBox(corners);
  ARETE_TRY(const int columns, sizeOf(box.xMax - box.xMin, cell));
  ARETE_TRY(const int rows, sizeOf(box.yMax - box.yMin, cell));
  return CellGrid{columns, rows, {box.xMin, cell, 0, box.yMax, 0, -cell}};
}

}  // namespace arete
