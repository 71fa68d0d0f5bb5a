// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "engine/base/vec.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// A bounding box of the terrain in plan coordinates: for a raster the whole grid (O(1)); for points the box
/// of the root's vertices, which is also that of all points (O(root vertices)); {0, 0, 0, 0} if the model
/// has no vertices.
Box2 planBox(const TerrainModel& model);
/// The columns of the raster that a model was built from: without the first one's repetition
/// (Georeference::repeatsFirstColumn). Precondition: a raster.
std::uint32_t sourceColumns(const TerrainModel& model);
/// As planBox(), of the source: without that column.
Box2 sourcePlanBox(const TerrainModel& model);
/// The bounding box of `positions`; {0, 0, 0, 0} if there are none. O(positions).
Box2 planBox(std::span<const Vec2> positions);

}  // namespace arete
