// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/triangle_mesh.h"
#include "surface/model/surface_model.h"

namespace arete {

/// For each face of a source that a mended mesh does not have, one that it has and in which the other's
/// middle lies: of those that are nearest to it but for rounding, for a duplicate its twin, else that with
/// the most corners in common, by position, then the first. A face that touches none, by the positions of its
/// corners, is left out. O(n log n).
/// @param faceOf by triangle of the mended mesh: the face of the source
std::vector<SurfaceModel::LeftOutFace> leftOutFacesOf(const TriangleMesh& source, const TriangleMesh& mended,
                                                      std::span<const std::uint32_t> faceOf);

}  // namespace arete
