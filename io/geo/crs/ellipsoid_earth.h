// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "engine/base/result.h"
#include "terrain/sight/earth.h"

namespace arete {

/// The usual refraction coefficient k: the effective radius of the Earth is R / (1 - k).
inline constexpr double kUsualRefraction = 1.0 / 7;

/// Whether makeEllipsoidEarth() has an ellipsoid: a CRS with longitude and latitude.
bool isOnEllipsoid(const Georeference& georeference);

/// The Earth as the ellipsoid of the DEM's CRS (docs/topics/visibility.md). Sight lines follow geodesics
/// [Karney2013], divided into 2^k segments that are straight in plan. The Earth curves below them by (1 -
/// refraction) / R, where R is the radius of curvature at the middle of the line, in its direction there, by
/// Euler's theorem. Works with any ellipsoid or sphere; no datum is transformed.
///
/// If the geodesic crosses the seam of longitudes of a geographic DEM, the track leaves the DEM on one side
/// and enters it on the other, with no terrain below it in between.
///
/// track(): O(segments); a geographic CRS needs no PROJ. Errors: invalidData: a position without longitude
/// and latitude; a line over a pole or along the seam of a map, which is not a line in plan; a line of half a
/// turn of the effective Earth or more.
///
/// @param model Must outlive the result.
/// @param refraction The coefficient k.
///
/// Errors: usage: no CRS. unsupported: a CRS without longitude and latitude. invalidData: PROJ has no
/// transformation.
Result<std::unique_ptr<SightEarth>> makeEllipsoidEarth(const TerrainModel& model,
                                                       double refraction = kUsualRefraction);
Result<std::unique_ptr<SightEarth>> makeEllipsoidEarth(TerrainModel&& model, double refraction = 0) = delete;

}  // namespace arete
