// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "terrain/fit/mesh.h"

namespace arete {

/// Groups of the vertices of a mesh that have no triangle in common within a group: the vertices of one group
/// can move at the same time. Vertices that are fixed or not in the mesh are in no group. The groups depend
/// on the mesh alone. O(triangles), some ten groups.
std::vector<std::vector<std::uint32_t>> independentVertices(const FitMesh& mesh);

/// The triangles and vertices of a mesh by square cells of the plan.
struct FitCells {
  std::vector<std::uint32_t> ofSlot;    ///< per slot: the cell with the centroid of the triangle
  std::vector<std::uint32_t> ofVertex;  ///< per vertex: the cell that it is in
  std::uint32_t count = 1;
};

/// @param across  cells along the longer side of the box around the mesh; 1 or more. O(triangles)
FitCells cellsOf(const FitMesh& mesh, std::uint32_t across);

}  // namespace arete
