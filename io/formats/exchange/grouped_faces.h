// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "io/formats/exchange/mesh_formats.h"
#include "surface/model/surface_mesh.h"

namespace arete {

/// The order of the triangles of a mesh in a format that states an object, a group or a material once for the
/// faces that follow: by object, then by group, then by material, those of none first, else as they are.
///
/// @return By triangle of the file: that of the mesh. Empty: the triangles already are in runs, one for each
/// object, and in it one for each group and material. O(n log n).
std::vector<std::uint32_t> groupedFaces(MeshRef mesh);

/// The same for a format: empty where the format needs no such order. writeMesh() writes in this order.
std::vector<std::uint32_t> trianglesOfFile(MeshRef mesh, const MeshFormat& format);

/// The mesh with its triangles, and all that belongs to them, in that order. O(size).
SurfaceMesh inOrder(MeshRef mesh, const std::vector<std::uint32_t>& triangleOf);

}  // namespace arete
