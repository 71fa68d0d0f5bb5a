// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>

#include "engine/base/vec.h"
#include "terrain/measure/triangle.h"

namespace arete::measuring {

/// Whether a triangle holds a point of the plan, and how: inside, on an edge or at a corner. This is decided
/// exactly, on the doubles as they are, however thin the triangle is; the height is within a few ulp of the
/// corners' differences. O(1). Precondition: all finite.
/// @param corner  in either orientation
/// @return the contact; nothing where the point is outside or the triangle has no area
std::optional<Contact> contactWhereHeld(const std::array<Vec3, 3>& corner, Vec2 point);

}  // namespace arete::measuring
