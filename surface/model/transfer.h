// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "engine/base/result.h"
#include "surface/model/surface_mesh.h"

namespace arete {

/// Gives another shape the attributes of a mesh: of a mesh that was repaired,
/// welded or cropped.
///
/// A corner has the attributes of the corner of its source triangle at the same
/// position, to the bit. A corner elsewhere in that triangle, as at a split
/// edge, has their averages; labels are those of the nearest corner. The
/// triangles of filled holes have no object, group or material; their wedges
/// have the attributes of any corner at the vertex, and zeros where there is
/// none.
///
/// @param shape       its triangles may turn the other way than their sources.
/// @param vertexOf    by vertex of `shape`: the vertex of `source` that it is.
/// @param triangleOf  by triangle of `shape`: the triangle of `source` it is or
/// is a part of; kNone: none. O(size). Errors: those of SurfaceMesh::validate()
/// of either mesh; invalidData: sizes that do not fit.
Result<SurfaceMesh> transferAttributes(const SurfaceMesh& source, TriangleMesh shape,
                                       std::span<const std::uint32_t> vertexOf,
                                       std::span<const std::uint32_t> triangleOf);

}  // namespace arete
