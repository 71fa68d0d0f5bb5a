// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "terrain/sight/answer.h"
#include "terrain/sight/line.h"
#include "terrain/sight/profile.h"

namespace arete {

/// Radio needs more room than light: the first Fresnel zone about the line, whose radius `s` metres from one
/// end of a path of S metres is F1 = sqrt(lambda s (S - s) / S) (ITU-R P.526). Links are planned with 0.6 of
/// it clear.
inline constexpr double kUsualFresnel = 0.6;

/// lambda in metres of a frequency in MHz.
double wavelengthMetres(double megahertz);

/// F1 in metres at a distance of `length`; 0 at the ends.
double fresnelRadius(double wavelength, double distance, double length);

/// Where the terrain comes furthest into the zone.
struct FresnelClearance {
  double fraction = 0;  ///< clearance / F1; 1 = the first zone is clear, negative = the line is blocked
  SightPlace place;     ///< where
};

/// The least clearance / F1 over a path's terrain; nothing where there is none between the ends, or no
/// length, or where an end is below the ground. An end itself has no zone. O(vertices). The least over each
/// straight stretch of terrain is found by sections, since clearance is convex and F1 concave: to 1e-9 of the
/// stretch where the line is clear.
std::optional<FresnelClearance> leastFresnelClearance(const SightLine& line, const Profile& profile,
                                                      double wavelength);

}  // namespace arete
