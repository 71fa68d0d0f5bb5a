// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>

#include "engine/base/vec.h"
#include "terrain/model/georeference.h"

namespace arete {

/// The scale of the map of a projected CRS along x and along y: lengths on the map for a length of 1 on the
/// ground, by geodesics [Karney2013] of a hundred metres each way. Nothing for other CRSs, and where the map
/// has no longitude and latitude.
std::optional<std::array<double, 2>> mapScaleAt(const Georeference& georeference, Vec2 xy);

/// Sets Georeference::mapScale to the scale at a position, the middle of the DEM, where it is off 1 by more
/// than a hundredth along an axis; clears it otherwise.
void stateMapScale(Georeference& georeference, Vec2 middle);

}  // namespace arete
