// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "engine/base/vec.h"

namespace arete {

/// Whether the plane through a, b, c differs at p from the height of p by more than `bound`, decided by exact
/// arithmetic. O(1), about a microsecond. Preconditions: a, b, c counter-clockwise in the plan, not on a
/// line; everything finite.
bool isErrorAbove(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p, double bound);

}  // namespace arete
