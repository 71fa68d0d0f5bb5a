// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "io/geo/features/feature_layer.h"
#include "terrain/model/terrain_model.h"
#include "viewer/picture/picture.h"
#include "viewer/scene/layer.h"

namespace arete {

/// The areas of a layer's polygons in one colour, as a picture over the plan of a terrain; holes, by the
/// even-odd rule of each polygon, stay free. At most `mostSide` pixels along a side: a pixel on the rim is as
/// opaque as its part of the area.
///
/// @return nothing where no area meets the terrain. O(pixels + edges * rows they cross).
std::optional<PlanPicture> fillOf(const FeatureLayer& layer, const TerrainModel& model, Rgb color,
                                  int mostSide = 2048);

}  // namespace arete
