// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "viewer/color/rgb.h"

namespace arete {

/// A colour under a multiple of the light that shows it as it is, channel by channel. Light is
/// added up and multiplied in linear intensities; above 1 it approaches full intensity without ever reaching
/// it, so that no slope that faces the sun is clipped: x becomes k x / (1 + (k - 1) x).
/// viewer/gl/shaders/light.glsl does the same. Precondition: no light is negative.
Rgb lit(Rgb color, const std::array<double, 3>& light);

}  // namespace arete
