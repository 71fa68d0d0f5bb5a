// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/vec.h"

namespace arete {

/// The points along the curve of Hilbert (1891) through the square around them: those near each other in this
/// order are near each other on the plan. Points that stand at one place follow each other, by their indices;
/// for the rest the order depends on the places alone, not on how the points are numbered. O(n log n),
/// parallel. Precondition: all coordinates are finite.
std::vector<std::uint32_t> groundOrder(std::span<const Vec2> positions);

}  // namespace arete
