// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

namespace arete {

/// The largest power of two that divides every height. With it, an error in doubles often gives the exact
/// error: see RasterError::isAbove(). O(heights), parallel.
/// @param heights  finite, or NaN for NODATA
/// @return 0 where all heights are 0 or the power is so small or so large that its inverse overflows
double commonUnit(std::span<const double> heights);

}  // namespace arete
