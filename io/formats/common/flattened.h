// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>

#include "engine/base/triangle_mesh.h"

namespace arete {

/// Counts the triangles that have an area and lose it where their positions are rounded to floats of 32 bits:
/// two corners become one, or all three lie on a line. Exact but for differences of doubles. O(triangles).
/// @param rounded the position of a vertex in the file; the origin of the file does not matter.
std::uint64_t countFlattened(const TriangleMesh& mesh,
                             const std::function<std::array<float, 3>(std::uint32_t)>& rounded);

/// As in MeshWriteReport::lost; empty for none.
std::string flattenedLoss(std::uint64_t count);

}  // namespace arete
