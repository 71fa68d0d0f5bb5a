// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "viewer/picture/picture.h"

namespace arete {

/// Evenly spaced colours, mixed linearly in between; `fraction` is clamped to 0..1, NaN gives the first
/// colour.
Rgb rampColor(std::span<const Rgb> ramp, double fraction);

/// Blue through near-white to brown, equally dark at both ends: distinct with any colour vision, and in grey
/// by the distance from the middle. For signed values; the middle is zero.
std::span<const Rgb> divergingRamp();

/// Muted greens, sands and stone, for heights under a hillshade.
std::span<const Rgb> hypsometricRamp();

}  // namespace arete
