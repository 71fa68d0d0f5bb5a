// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>

#include "engine/base/vec.h"
#include "terrain/measure/triangle.h"

namespace arete::measuring {

/// How a triangle meets a place of the plan that it holds, edges and corners included; none where it does
/// not, or has no area. Whether it holds the place, inside, on an edge or at a corner, is decided exactly, on
/// the doubles as they are, however thin it is; the height is within a few ulp of the corners' differences.
/// Either orientation. O(1). Precondition: all finite.
std::optional<Contact> contactWhereHeld(const std::array<Vec3, 3>& corner, Vec2 place);

}  // namespace arete::measuring
