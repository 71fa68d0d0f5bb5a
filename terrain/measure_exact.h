// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>

#include "engine/vec.h"

namespace arete::measuring {

/// The height of a triangle over a place of the plan that it holds, edges and corners included; none where it
/// does not, or has no area. Whether it holds the place is decided exactly, on the doubles as they are,
/// however thin it is; the height is within a few ulp of the corners' differences. Either orientation. O(1).
/// Precondition: all finite.
std::optional<double> heightWhereHeld(const std::array<Vec3, 3>& corner, Vec2 place);

}  // namespace arete::measuring
