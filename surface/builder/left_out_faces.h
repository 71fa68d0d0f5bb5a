// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/triangle_mesh.h"
#include "surface/model/surface_model.h"

namespace arete {

/// For each face of a source that a mended mesh does not have, one that it has and in which the other lies: a
/// duplicate in the one that stays, one without area in one at its corners. Of those with a corner
/// in common, by position, it is the one nearest to its middle, then that with the most, then the first. A
/// face that touches none is left out. O(n log n).
/// @param faceOf by triangle of the mended mesh: the face of the source
std::vector<SurfaceModel::LeftOutFace> leftOutFacesOf(const TriangleMesh& source, const TriangleMesh& mended,
                                                      std::span<const std::uint32_t> faceOf);

}  // namespace arete
