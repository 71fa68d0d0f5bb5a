// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "engine/base/vec.h"

namespace arete {

/// Where a format of 32-bit floats puts its zero, so that little is rounded: x and y of vertices near the
/// middle, height 0 (or, where float32 cannot hold the heights and they are far from 0 compared
/// with their range, that of a vertex too). A vertex rather than the middle itself: the distances of a grid's
/// samples from one of them are whole numbers of pixels, which float32 often holds exactly, as it does the
/// heights of most DEMs. {0, 0, 0} for no vertices. O(vertices).
Vec3 localOrigin(std::span<const Vec3> positions);

/// How far a float32 number of this size may be from the double it was made of, where `origin` was taken
/// away before and is added again.
double float32Rounding(double largestAbsolute, double origin);

}  // namespace arete
