// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>

#include "engine/base/vec.h"
#include "terrain/measure/triangle.h"

namespace arete::measuring {

/// Whether a triangle contains a point of the plan: inside, on an edge or at a corner. This is decided by
/// exact arithmetic, so it is right for any thin triangle. The height is off by at most a few ulp of the
/// differences between the corners' heights. O(1). Precondition: all coordinates are finite.
/// @param corner  in either orientation
/// @return the contact; nothing where the point is outside or the triangle has no area
std::optional<Contact> contactWhereHeld(const std::array<Vec3, 3>& corner, Vec2 point);

}  // namespace arete::measuring
