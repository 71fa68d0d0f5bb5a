// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

#include "engine/base/nearest_on_triangle.h"
#include "surface/error/original.h"
#include "surface/error/pieces.h"

namespace arete {

/// How far the corners of a triangle may be displaced, as SurfaceDisplacement::reaches has it: the largest
/// part of `error`, at most 1, up to which scales, whichever each corner has, leave no corner of a piece
/// farther than `error` from the triangle. Rounded down.
/// @param directions of the corners
/// @param error      above 0
/// @param corners    their numbers, by which pieces name sides
std::uint8_t reachOf(const OriginalSurface& original, const PieceList& pieces, const SpaceTriangle& triangle,
                     const std::array<Vec3, 3>& directions, double error,
                     const std::array<std::uint32_t, 3>& corners = {0, 1, 2});

}  // namespace arete
