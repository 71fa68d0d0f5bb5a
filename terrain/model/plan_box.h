// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "engine/base/vec.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// A box around the terrain, in plan coordinates: the grid of a raster; of points that of the root, which
/// spans all that is there. Of a model without vertices {0, 0, 0, 0}. O(1) of a raster, O(root vertices) of
/// points.
Box2 planBox(const TerrainModel& model);
/// The least around some places; of none {0, 0, 0, 0}. O(places).
Box2 planBox(std::span<const Vec2> places);

}  // namespace arete
