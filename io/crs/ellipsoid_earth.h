// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "engine/base/result.h"
#include "terrain/sight/earth.h"

namespace arete {

/// What the air does to a ray, of the Earth's curvature: the effective radius is R / (1 - K).
inline constexpr double kUsualRefraction = 1.0 / 7;

/// The Earth as the ellipsoid of the DEM's CRS, docs/topics/visibility.md: lines of sight run over geodesics
/// (GeographicLib: Karney 2013), cut into 2^k pieces straight in plan, and the Earth curves below them by
/// (1 - refraction) / R, R the radius of curvature in the middle of the line in its direction there (Euler).
/// Any ellipsoid or sphere will do, of any datum; none is changed.
///
/// Where longitudes come round to the other side of a geographic DEM, the track leaves it on one side and
/// enters it on the other; on the way it has no terrain below it.
///
/// track(): O(pieces); a geographic CRS asks no PROJ. Its errors: invalidData for a place that has no
/// longitude and latitude, a line over a pole or along the seam of a map, which is no line in plan, and one
/// of half a turn or more of the effective Earth.
///
/// Precondition: the model outlives the Earth. Errors: usage (no CRS), unsupported (a CRS that knows no
/// longitude and latitude), invalidData (PROJ knows no way).
Result<std::unique_ptr<SightEarth>> makeEllipsoidEarth(const TerrainModel& model,
                                                       double refraction = kUsualRefraction);

}  // namespace arete
