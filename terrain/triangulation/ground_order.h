// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/vec.h"

namespace arete {

/// The indices of points in the order of a Hilbert curve [Hilbert1891] through the square around them: points
/// near each other in this order are near each other in the plan. Points with equal coordinates are
/// consecutive, by their indices; otherwise the order depends on the coordinates alone, not on the numbering.
/// O(n log n), parallel. Precondition: all coordinates are finite.
std::vector<std::uint32_t> groundOrder(std::span<const Vec2> positions);

}  // namespace arete
