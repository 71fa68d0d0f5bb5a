// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "engine/mt/multitriangulation.h"

namespace arete {

/// The slot, in the star of the node that removes a triangle, of the triangle that follows it: the first with
/// a common edge, or else with a common corner. Precondition: `node` removes t. O(star).
std::uint32_t successorSlotOf(const MultiTriangulation& mt, TriangleId t, NodeId creator, NodeId node);

/// Gives every triangle that a node removes the face of the one that follows it (successorSlotOf()).
/// @param faceOf by triangle of the MT; those of the finest front are read. O(triangles).
void inheritFaces(const MultiTriangulation& mt, std::span<std::uint32_t> faceOf);

}  // namespace arete
