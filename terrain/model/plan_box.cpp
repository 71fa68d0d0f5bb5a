// SPDX-License-Identifier: GPL-3.0-or-later
//
// A plain minimum and maximum of coordinates.
#include "terrain/model/plan_box.h"

#include <algorithm>

namespace arete {

Box2 planBox(const TerrainModel& model) {
  if (model.isRaster) return {0, 0, model.columns - 1.0, model.rows - 1.0};
  Box2 box{0, 0, 0, 0};
  for (std::uint32_t v = 0; v < model.mt.rootVertexCount(); ++v) {
    const Vec2 p = model.mt.vertices().planPosition(VertexId(v));
    if (v == 0) box = {p.x, p.y, p.x, p.y};
    box = {std::min(box.xMin, p.x), std::min(box.yMin, p.y), std::max(box.xMax, p.x),
           std::max(box.yMax, p.y)};
  }
  return box;
}

std::uint32_t sourceColumns(const TerrainModel& model) {
  return model.columns - (model.georeference.repeatsFirstColumn && model.columns > 1 ? 1 : 0);
}

Box2 sourcePlanBox(const TerrainModel& model) {
  Box2 box = planBox(model);
  if (model.isRaster) box.xMax = sourceColumns(model) - 1.0;
  return box;
}

Box2 planBox(std::span<const Vec2> positions) {
  if (positions.empty()) return {0, 0, 0, 0};
  Box2 box{positions[0].x, positions[0].y, positions[0].x, positions[0].y};
  for (const Vec2& p : positions)
    box = {std::min(box.xMin, p.x), std::min(box.yMin, p.y), std::max(box.xMax, p.x),
           std::max(box.yMax, p.y)};
  return box;
}

}  // namespace arete
