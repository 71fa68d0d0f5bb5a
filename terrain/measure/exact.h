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

/// The plane's height minus the sample's, from exact arithmetic: off by at most a few parts in 2^53 of
/// itself. O(1), about a microsecond.
/// @param corner  in either orientation
/// @return nothing where the triangle does not hold the sample in the plan, has no area, or a number is not
///         finite
std::optional<double> errorWhereHeld(const std::array<Vec3, 3>& corner, const Vec3& sample);

}  // namespace arete::measuring
