// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "io/geo/features/feature_layer.h"
#include "terrain/locate/ground_height.h"

namespace arete {

/// A place well inside a polygon, on the terrain: far from the rim of the part of the polygon that is on the
/// terrain, so outside its holes and off voids. It is found on a grid over that part.
///
/// @param rings lines of one polygon, outline and holes
/// @return nothing where no place of the grid is in the polygon and on the terrain. O(vertices of the rings).
std::optional<Vec2> placeInside(const FeatureLayer& layer, std::span<const FeatureLayer::Line> rings,
                                const GroundHeights& heights);

}  // namespace arete
