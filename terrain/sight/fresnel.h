// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "terrain/sight/answer.h"
#include "terrain/sight/line.h"
#include "terrain/sight/profile.h"

namespace arete {

/// The part of the first Fresnel zone that radio planners usually keep clear [ItuLineOfSight2021]. The zone's
/// radius, s metres from one end of a path of S metres, is F1 = sqrt(lambda s (S - s) / S)
/// [ItuDiffraction2019].
inline constexpr double kUsualFresnel = 0.6;

/// @return lambda in metres of a frequency in MHz.
double wavelengthMetres(double megahertz);

/// @return F1 in metres, `distance` metres from one end of a path of `length` metres; 0 at the ends and
/// beyond.
double fresnelRadius(double wavelength, double distance, double length);

/// Where the terrain reaches furthest into the zone.
struct FresnelClearance {
  double fraction = 0;  ///< clearance / F1; 1 = the terrain touches the zone, negative = the line is blocked
  SightPlace place;
};

/// The least clearance / F1 along a path. Over a straight stretch of terrain the clearance is convex and F1
/// concave, so the quotient has one minimum where the line is clear; golden section finds it to 1e-9 of the
/// stretch. O(vertices).
/// @param profile that of the line's track, at full resolution.
/// @return nothing if there is no terrain between the ends, the line has no length, or an end is below the
///     ground (the zone narrows to 0 there, so the quotient has no least value). An end itself has no zone.
std::optional<FresnelClearance> leastFresnelClearance(const SightLine& line, const Profile& profile,
                                                      double wavelength);

}  // namespace arete
