// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/vec.h"

namespace arete::repair_passes {

/// By vertex: the lowest vertex at its position. O(n log n).
std::vector<std::uint32_t> placesOf(std::span<const Vec3> positions);

}  // namespace arete::repair_passes
