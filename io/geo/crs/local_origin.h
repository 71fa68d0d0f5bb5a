// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "engine/base/vec.h"

namespace arete {

/// Chooses the origin of a format of 32-bit floats so that little is rounded: x and y of vertices near the
/// middle and height 0; or also the height of a vertex, if float32 does not hold the heights exactly and they
/// are far from 0 compared with their range. Vertices instead of the middle itself, because the distances
/// between samples of a grid are whole numbers of pixels, which float32 often holds exactly. O(vertices).
///
/// @return {0, 0, 0} for no vertices.
Vec3 localOrigin(std::span<const Vec3> positions);

/// Upper bound on the error of a double that is stored as float32 relative to an origin.
///
/// @param largestAbsolute Bound on the absolute value of the stored numbers.
/// @param origin Subtracted before storing, added after reading.
double float32Rounding(double largestAbsolute, double origin);

}  // namespace arete
