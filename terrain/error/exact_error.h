// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "engine/base/vec.h"

namespace arete {

// Decisions by exact arithmetic, where doubles do not suffice. Each is O(1) and takes about a microsecond.
// Precondition of all: every number is finite.

/// Whether the plane through a, b, c differs at p from the height of p by more than `bound`. Precondition: a,
/// b, c are counter-clockwise in the plan and not on a line.
bool isErrorAbove(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p, double bound);

/// Whether the segment a-b differs at p from the height of p by more than `bound`. Precondition: p lies on
/// the segment in the plan.
bool isErrorAboveOnLine(const Vec3& a, const Vec3& b, const Vec3& p, double bound);

/// Whether the plane through a, b, c lies above p (> 0), below it (< 0) or passes through it. Precondition:
/// as for isErrorAbove().
int signAt(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p);

/// Whether the segment a-b passes above the segment p-q (> 0), below it (< 0) or through it. Precondition: in
/// the plan they cross, and are not parallel.
int signAtCrossing(const Vec3& a, const Vec3& b, const Vec3& p, const Vec3& q);

}  // namespace arete
