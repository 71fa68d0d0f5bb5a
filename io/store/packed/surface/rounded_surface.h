// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "engine/base/result.h"
#include "engine/mt/multitriangulation.h"

namespace arete::packed {

/// A surface whose coordinates are multiples of a step, if there is one.
struct RoundedSurface {
  MultiTriangulation mt;  ///< its saturated errors and spheres are those before rounding
  double step = 0;        ///< a power of two; 0: the coordinates are no multiples that fewer bits name
  double moved = 0;       ///< the largest distance by which a vertex moved
};

inline constexpr int kLeastPositionBits = 8, kMostPositionBits = 24;

/// @param positionBits  0: the places stay, and the largest power of two that they are multiples of is found.
///   Otherwise each coordinate is rounded to a multiple of the least power of two for which the longest side
///   of the box has at most 2^positionBits - 1 steps. A point of a triangle moves no farther than its
///   corners, so a distance between a piece of the finest surface and a triangle grows by at most twice the
///   largest move, and one between a piece of the source and a triangle by once: every error grows by twice,
///   and is rounded upwards to 1/128 of an octave.
/// Errors: invalidData: positionBits out of range. O(vertices + triangles).
Result<RoundedSurface> roundedSurface(const MultiTriangulation& mt, int positionBits);

}  // namespace arete::packed
