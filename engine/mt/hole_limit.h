// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace arete {

/// The most corners a hole can have: the largest degree bound a build accepts, and one more for an open star.
/// The file format relies on it: a floor has at most kMaxHoleCorners - 2 triangles.
inline constexpr int kMaxHoleCorners = 33;

}  // namespace arete
