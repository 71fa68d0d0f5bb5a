// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/vec.h"

namespace arete::repair_passes {

/// The pairs of some points within a distance of each other, the nearest first, then by their numbers. O(n
/// log n + pairs whose coordinates are within the distance).
std::vector<std::pair<std::uint32_t, std::uint32_t>> findNearPairs(std::span<const Vec3> positions,
                                                                   std::span<const std::uint32_t> points,
                                                                   double distance);

}  // namespace arete::repair_passes
