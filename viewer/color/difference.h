// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "viewer/color/rgb.h"

namespace arete {

/// A colour of CIE 1976 L*a*b* under D65, the white of sRGB: lightness 0 to 100, green to red, blue to
/// yellow.
struct Lab {
  double lightness = 0, a = 0, b = 0;
};

/// The linear intensities of an sRGB colour, 0 to 1 (IEC 61966-2-1).
std::array<double, 3> linearOf(Rgb color);
/// The sRGB colour of linear intensities, rounded and clamped.
Rgb rgbOfLinear(const std::array<double, 3>& linear);

Lab labOf(Rgb color);

/// How different two colours look: CIEDE2000 with all parametric factors 1. About 1 is just noticeable side
/// by side; 10 is plainly another colour. Source: [Sharma2005].
double colorDifference(const Lab& a, const Lab& b);
double colorDifference(Rgb a, Rgb b);

}  // namespace arete
