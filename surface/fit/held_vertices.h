// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "surface/model/surface_mesh.h"

namespace arete {

/// By vertex: whether it stays in a fit, because something ends there that would be torn off: it has several
/// wedges, or triangles of several objects, materials or labels. O(n log n).
/// @param keepsBorders  vertices on borders stay, too
std::vector<std::uint8_t> heldVertices(const SurfaceMesh& mesh, bool keepsBorders);

}  // namespace arete
