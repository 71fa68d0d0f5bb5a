// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "surface/decimate/decimate.h"

namespace arete {

/// A decimated mesh of a method that knows nothing of corners: vertices have the attributes of a vertex of
/// the source each, triangles those of a triangle, and corners have none yet (takeNearestAttributes()).
DecimatedMesh carried(const SurfaceMesh& source, TriangleMesh shape, std::vector<std::uint32_t> vertexOf,
                      std::vector<std::uint32_t> faceOf);

}  // namespace arete
