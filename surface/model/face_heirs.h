// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "engine/mt/multitriangulation.h"

namespace arete {

/// Gives every triangle that a node removes the face of one that the node puts in its place: of the first in
/// the star with a common edge, or else with a common corner.
/// @param faceOf by triangle of the MT; those of the finest front are read. O(triangles).
void inheritFaces(const MultiTriangulation& mt, std::span<std::uint32_t> faceOf);

}  // namespace arete
