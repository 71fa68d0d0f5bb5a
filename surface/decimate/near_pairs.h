// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "surface/decimate/contraction_mesh.h"

namespace arete {

/// Pairs of vertices that have no edge to each other and are nearer than 1/200 of the diagonal of the box
/// around all vertices, the smaller number first. Always in the same order. O(n log n + pairs within that
/// distance).
std::vector<std::array<std::uint32_t, 2>> nearPairs(const ContractionMesh& mesh);

}  // namespace arete
