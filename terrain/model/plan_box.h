// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "engine/base/vec.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// A bounding box of the terrain in plan coordinates: the whole grid of a raster (O(1)); for points, the box
/// of the root's vertices, which is that of all points (O(root vertices)). {0, 0, 0, 0} for a model without
/// vertices.
Box2 planBox(const TerrainModel& model);
/// The bounding box of some positions; {0, 0, 0, 0} for none. O(positions).
Box2 planBox(std::span<const Vec2> positions);

}  // namespace arete
